/** The one 3-D viewer of the page. Views borrow it, because a second one would compile all shaders again. */
import type { Role } from "../../humanoid";
import { html } from "../../ui/dom";
import { VIEWER_DEFAULTS, Viewer } from "../../viewer";
import type { Film, PictureSize } from "../ui/film";
import type { ViewerLease } from "../view";

/** Drawing continues for this time after the last change, in which glides and fades end. */
const AFTERGLOW_MS = 1200;
/** A picture for which the GPU was not ready is tried again after this time. */
const RETRY_MS = 4;
/** After this time without a restored context, milliseconds, it counts as lost. */
const LOST_MS = 3000;

export class SharedViewer {
  /** Created when a view first needs it, so that a browser without 3-D can show the other views. */
  #made: Viewer | undefined;
  #theme: "dark" | "light";
  readonly #container = html("div", { class: "stage-view" });
  readonly #observer = new ResizeObserver(() => this.#invalidate());
  #borrower: HTMLElement | undefined;
  #tinted: readonly Role[] = [];
  /** Whether nothing is drawn, not even the finer picture of a still scene, which takes longer. */
  #frozen = false;
  #drawUntil = 0;
  /** Settles with the last task of {@link film}. */
  #lastFilm: Promise<unknown> = Promise.resolve();
  /** Whether drawing is off because something else is drawn over it. */
  rests = false;

  readonly #listening = new AbortController();

  /** @param onLost called when the WebGL context is lost for a while, and when it is restored */
  constructor(theme: "dark" | "light", onLost: (lost: boolean) => void) {
    this.#theme = theme;
    this.#watchContext(onLost);
    for (const type of ["pointerdown", "pointermove", "wheel", "keydown"])
      this.#container.addEventListener(type, () => this.#invalidate(), { passive: true });
    this.#observer.observe(this.#container);
  }

  set theme(theme: "dark" | "light") {
    this.#theme = theme;
    if (this.#made) this.#made.theme = theme;
    this.#invalidate();
  }

  /** Creates the viewer before a view needs it. */
  make(): void {
    void this.#viewer;
  }

  get #viewer(): Viewer {
    this.#made ??= new Viewer(this.#container, { theme: this.#theme, labels: { styled: "", input: "" } });
    return this.#made;
  }

  /** Moves the viewer into a container, without the contents of the previous one. */
  borrow(container: HTMLElement): ViewerLease {
    const viewer = this.#viewer;
    this.#frozen = false;
    if (this.#borrower !== container) {
      if (this.#borrower) this.#clear();
      this.#borrower = container;
      container.append(this.#container);
    }
    viewer.resetTrail();
    this.#invalidate();
    return {
      viewer,
      element: this.#container,
      invalidate: () => this.#invalidate(),
      freeze: (frozen) => {
        this.#frozen = frozen;
      },
      film: this.film,
      tint: (joints) => {
        this.#tinted = joints;
        viewer.tinted = joints;
        this.#invalidate();
      },
    };
  }

  /** The events of a canvas do not bubble, but can be captured here. */
  #watchContext(onLost: (lost: boolean) => void): void {
    const { signal } = this.#listening;
    let wait: ReturnType<typeof setTimeout> | undefined;
    const stop = () => clearTimeout(wait);
    const lost = () => {
      stop();
      wait = setTimeout(() => onLost(true), LOST_MS);
    };
    const restored = () => {
      stop();
      onLost(false);
    };
    this.#container.addEventListener("webglcontextlost", lost, { capture: true, signal });
    this.#container.addEventListener("webglcontextrestored", restored, { capture: true, signal });
    signal.addEventListener("abort", stop);
  }

  #clear(): void {
    const viewer = this.#viewer;
    this.#tinted = [];
    viewer.tinted = [];
    viewer.labels = { styled: "", input: "" };
    viewer.description = VIEWER_DEFAULTS.description;
    void viewer.setPerformer(null);
    viewer.setInput(null);
    viewer.setPath(null);
    viewer.motionTrail = "off";
    viewer.setPlanted([false, false]);
    viewer.follow = true;
    viewer.camera("orbit");
    viewer.onViewChange = undefined;
    viewer.onFps = undefined;
  }

  #invalidate(): void {
    this.#drawUntil = performance.now() + AFTERGLOW_MS;
  }

  /** Draws if anything may have changed, and until the viewer has drawn its still picture. Returns whether it did. */
  draw(now: number): boolean {
    if (!this.#made || this.#frozen || this.rests) return false;
    return (now < this.#drawUntil || !this.#made.still) && this.#made.render(now / 1000);
  }

  /** A copy of the picture, drawn now or as soon as the GPU is ready, at a size that may differ from the displayed one. */
  picture(size?: PictureSize): Promise<HTMLCanvasElement> {
    return this.film((pictureAt) => pictureAt(0), { size });
  }

  /**
   * Runs a task that controls all drawing: each picture shows its own time, seconds from the start, however long it
   * takes to draw, without marks of editing. Pictures are drawn at `size`, or at the displayed size. A task waits for the
   * one before it, which may still be ending after it was cancelled.
   * @throws the reason with which `signal` was aborted
   */
  readonly film: Film = (task, options) => {
    const film = this.#lastFilm.then(() => this.#film(task, options));
    // Its result, a picture or a video, is not kept.
    const done = () => undefined;
    this.#lastFilm = film.then(done, done);
    return film;
  };

  readonly #film: Film = async (task, { signal, size } = {}) => {
    signal?.throwIfAborted();
    const viewer = this.#viewer;
    const start = performance.now() / 1000;
    const frozen = this.#frozen;
    this.#frozen = true;
    viewer.tinted = [];
    viewer.filmed = size;
    try {
      return await task(async (secs) => {
        for (;;) {
          signal?.throwIfAborted();
          viewer.invalidate();
          if (viewer.render(start + secs)) return viewer.copy();
          await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
        }
      });
    } finally {
      this.#frozen = frozen;
      viewer.filmed = undefined;
      viewer.tinted = this.#tinted;
      this.#invalidate();
    }
  };

  /** Position of a joint of the styled character in the page, CSS pixels. */
  jointPosition(role: Role): { x: number; y: number } {
    return this.#onPage(this.#viewer.jointScreenPosition(role));
  }

  /** Position of a point on the ground in the page, CSS pixels. */
  groundPosition(x: number, z: number): { x: number; y: number } {
    return this.#onPage(this.#viewer.screenPosition(x, 0, z));
  }

  #onPage({ x, y }: { x: number; y: number }): { x: number; y: number } {
    const box = this.#container.getBoundingClientRect();
    return { x: box.left + x, y: box.top + y };
  }

  dispose(): void {
    this.#listening.abort();
    this.#observer.disconnect();
    this.#made?.dispose();
  }
}
