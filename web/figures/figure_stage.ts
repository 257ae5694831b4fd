/** The 3-D picture of a figure: a viewer on the page's single screen, with marks over it. */

import { schedule, screens } from "../element/host";
import type { Drawing } from "../element/schedule";
import { html, svg } from "../ui/dom";
import type { Lease } from "../ui/lingering";
import { type Screen, Viewer, type ViewerOptions } from "../viewer";
import type { Words } from "./words/words";

/** Drawing continues for this time after the last change, in which glides and fades end. */
const AFTERGLOW_MS = 1200;
/** Longest time step, seconds: a page that was hidden does not jump. */
const LONGEST_STEP = 0.1;

/** Callbacks of a figure's picture. */
export interface StageListeners {
  /** Called while the picture is visible; omitted if nothing moves. */
  advance?: (dtSecs: number) => void;
  /** Called after a picture was drawn: marks are moved to its joints. */
  drawn?: () => void;
}

export class FigureStage implements Drawing {
  readonly hasFocus = false;
  readonly element = html("div", { class: "picture" });
  /** Marks over the picture, in its CSS pixels. */
  readonly overlay = svg("svg", { class: "overlay", "aria-hidden": "true" });
  /** `undefined` if the browser has no 3-D. */
  readonly viewer: Viewer | undefined;
  readonly #listeners: StageListeners;
  /** `undefined` if the browser has no 3-D. */
  readonly #screen: Lease<Screen> | undefined;
  #running = false;
  #lastDraw = 0;
  #drawUntil = 0;

  constructor(words: Words, options: Omit<ViewerOptions, "screen">, listeners: StageListeners = {}) {
    this.#listeners = listeners;
    try {
      this.#screen = screens.lease();
      this.viewer = this.#open(options, this.#screen.value);
    } catch {
      this.#screen?.release();
      this.element.replaceChildren(html("p", { class: "message" }, words.noGraphics));
    }
  }

  /** Sets whether it is visible: it draws only then. */
  run(running: boolean): void {
    if (running === this.#running) return;
    this.#running = running;
    if (running) {
      this.#lastDraw = performance.now();
      this.invalidate();
      schedule.add(this);
    } else schedule.remove(this);
  }

  /** Requests a redraw. */
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
    this.viewer?.dispose();
    this.#screen?.release();
  }

  #open(options: Omit<ViewerOptions, "screen">, screen: Screen): Viewer {
    const viewer = new Viewer(this.element, { ...options, screen });
    for (const type of ["pointerdown", "pointermove", "wheel", "keydown"])
      this.element.addEventListener(type, () => this.invalidate(), { passive: true });
    // The wheel scrolls the page of the lesson.
    viewer.zooming = "focused";
    viewer.onDraw = this.#listeners.drawn;
    this.element.append(this.overlay);
    return viewer;
  }
}
