/** The 3-D picture of a figure: a viewer on the page's one screen, with marks over it. */
import { html, svg } from "../../ui/dom";
import { Viewer, type ViewerOptions } from "../../viewer";
import { joinScreen, leaveScreen, schedule } from "../host";
import type { Drawing } from "../schedule";
import type { Words } from "./words/words";

/** Drawing goes on for so long after the last change: glides and fades end within it. */
const AFTERGLOW_MS = 1200;
/** A step of time is not longer, seconds: a page that was hidden does not leap. */
const LONGEST_STEP = 0.1;

/** What a figure does with its picture. */
export interface StageListeners {
  /** Time goes on while the picture is seen; where nothing moves, nothing is to be done. */
  advance?: (dtSecs: number) => void;
  /** A picture was drawn: marks go to where its joints are. */
  drawn?: () => void;
}

export class FigureStage implements Drawing {
  readonly hasFocus = false;
  readonly element = html("div", { class: "picture" });
  /** Marks over the picture, in its CSS pixels. */
  readonly overlay = svg("svg", { class: "overlay", "aria-hidden": "true" });
  /** `undefined` where the browser cannot draw in 3-D. */
  readonly viewer: Viewer | undefined;
  readonly #listeners: StageListeners;
  #running = false;
  #lastDraw = 0;
  #drawUntil = 0;

  constructor(words: Words, options: Omit<ViewerOptions, "screen">, listeners: StageListeners = {}) {
    this.#listeners = listeners;
    this.viewer = this.#open(words, options);
  }

  /** Says whether anybody sees it: it draws only then. */
  run(running: boolean): void {
    if (running === this.#running) return;
    this.#running = running;
    if (running) {
      this.#lastDraw = performance.now();
      this.invalidate();
      schedule.add(this);
    } else schedule.remove(this);
  }

  /** Something of the picture has changed. */
  invalidate(): void {
    this.#drawUntil = performance.now() + AFTERGLOW_MS;
    this.viewer?.invalidate();
  }

  setTheme(theme: "dark" | "light"): void {
    if (this.viewer) this.viewer.theme = theme;
    this.invalidate();
  }

  draw(now: number): boolean {
    const dtSecs = Math.min(LONGEST_STEP, Math.max(0, (now - this.#lastDraw) / 1000));
    this.#lastDraw = now;
    this.#listeners.advance?.(dtSecs);
    if (!this.viewer || (now > this.#drawUntil && this.viewer.still)) return false;
    return this.viewer.render(now / 1000);
  }

  dispose(): void {
    this.run(false);
    if (!this.viewer) return;
    this.viewer.dispose();
    leaveScreen();
  }

  #open(words: Words, options: ViewerOptions): Viewer | undefined {
    try {
      const viewer = new Viewer(this.element, { ...options, screen: joinScreen() });
      for (const type of ["pointerdown", "pointermove", "wheel", "keydown"])
        this.element.addEventListener(type, () => this.invalidate(), { passive: true });
      // The wheel scrolls the page of the lesson.
      viewer.zooming = "focused";
      viewer.onDraw = this.#listeners.drawn;
      this.element.append(this.overlay);
      return viewer;
    } catch {
      leaveScreen();
      this.element.replaceChildren(html("p", { class: "message" }, words.noGraphics));
      return undefined;
    }
  }
}
