/** The stage: the 3-D view with its title, camera buttons and read-out. */

import { ROLES, type Role, VIEWER_DEFAULTS, Viewer } from "../viewer";
import type { LiveFrame } from "../worker/protocol";
import { button, Segment } from "./controls/buttons";
import { formatNumber, html, setAttributes, setText } from "./dom";
import type { CameraPreset, PlayState } from "./state";
import { strings } from "./strings/strings";
import { partOf } from "./style_settings";

/** What the picture keeps being drawn for after the last change: glides and fades end within it. */
const AFTERGLOW_MS = 1200;
/** Read-outs change this often, so that they can be read. */
const READ_OUT_MS = 500;
/** A picture that the graphics processor was not ready for is tried again after this time. */
const RETRY_MS = 4;

export interface StageListeners {
  onCamera: (preset: CameraPreset) => void;
  onFollow: () => void;
  onGhost: () => void;
  onTrace: () => void;
  /** A joint of the styled character was clicked. */
  onJoint: (joint: Role) => void;
}

/** A click moves no farther than this, in pixels; a drag turns the camera. */
const CLICK_PX = 4;

export class Stage {
  readonly element: HTMLElement;
  readonly viewer: Viewer;
  readonly #view = html("div", { class: "stage-view" });
  readonly #title = html("h1", { class: "stage-title" });
  readonly #caption = html("p", { class: "caption" });
  readonly #camera: Segment<CameraPreset>;
  readonly #follow: HTMLButtonElement;
  readonly #ghost: HTMLButtonElement;
  readonly #trace: HTMLButtonElement;
  readonly #fps = html("span");
  readonly #cost = html("span");
  #lent = false;
  /** The part of the body that the polygon is of. */
  #part: PlayState["part"] = "";
  /** Whether nothing is drawn: not even the finer picture of what stands still, which takes its time. */
  frozen = false;
  #drawUntil = 0;
  #readOutAt = 0;

  constructor(theme: "dark" | "light", listeners: StageListeners) {
    const view = this.#view;
    this.#camera = new Segment<CameraPreset>(
      strings.play.camera.name,
      [
        { value: "orbit", label: strings.play.camera.orbit, icon: "orbit" },
        { value: "front", label: strings.play.camera.front },
        { value: "side", label: strings.play.camera.side },
        { value: "top", label: strings.play.camera.top },
      ],
      listeners.onCamera,
    );
    this.#follow = button(strings.play.follow, listeners.onFollow, {
      icon: "follow",
      label: true,
      class: "chip",
      keys: "F",
    });
    this.#trace = button(strings.play.trail.name, listeners.onTrace, {
      icon: "trail",
      label: true,
      class: "chip",
      keys: "T",
    });
    this.#ghost = button(strings.play.ghost.name, listeners.onGhost, {
      icon: "ghost",
      label: true,
      class: "chip",
      keys: "G",
    });
    this.element = html(
      "main",
      { class: "stage" },
      view,
      html("div", { class: "stage-heading" }, this.#title, this.#caption),
      html("div", { class: "stage-controls" }, this.#camera.element, this.#follow, this.#ghost, this.#trace),
      html("p", { class: "read-out caption" }, this.#fps, this.#cost, html("span", {}, strings.play.grid)),
    );
    this.viewer = new Viewer(view, { theme });
    this.viewer.onViewChange = listeners.onCamera;
    this.viewer.onFps = (fps) => setText(this.#fps, strings.play.fps(Math.round(fps)));
    for (const type of ["pointerdown", "pointermove", "wheel", "keydown"])
      view.addEventListener(type, () => this.invalidate(), { passive: true });
    new ResizeObserver(() => this.invalidate()).observe(view);
    this.#listenToClicks(listeners.onJoint);
  }

  #listenToClicks(onJoint: (joint: Role) => void): void {
    let down: { x: number; y: number } | undefined;
    this.#view.addEventListener("pointerdown", ({ button, clientX: x, clientY: y }) => {
      down = button === 0 ? { x, y } : undefined;
    });
    this.#view.addEventListener("click", ({ clientX: x, clientY: y }) => {
      if (this.#lent || !down || Math.hypot(x - down.x, y - down.y) > CLICK_PX) return;
      const box = this.#view.getBoundingClientRect();
      const joint = this.viewer.jointAt(x - box.left, y - box.top);
      if (joint) onJoint(joint);
    });
  }

  /** The words over the picture. */
  set heading({ title, caption }: { title: string; caption: string }) {
    setText(this.#title, title);
    setText(this.#caption, caption);
  }

  /** Shows the fields of the state that concern the view. */
  show(state: Readonly<PlayState>): void {
    if (this.#lent) return;
    this.#camera.value = state.camera;
    if (this.viewer.view !== state.camera) this.viewer.camera(state.camera);
    this.viewer.follow = state.follow;
    this.viewer.ghost = state.ghost;
    this.#follow.setAttribute("aria-pressed", String(state.follow));
    setAttributes(this.#ghost, {
      "aria-pressed": String(state.ghost !== "off"),
      title: `${strings.play.ghost[state.ghost]} (G)`,
    });
    this.#part = state.part;
    this.#tintPart(state.part);
    this.viewer.trace = state.trace;
    setAttributes(this.#trace, {
      "aria-pressed": String(state.trace !== "off"),
      title: `${strings.play.trail[state.trace]} (T)`,
    });
    this.invalidate();
  }

  /**
   * Moves the picture to another view, which shows in it what it wants, with {@link invalidate} after every change: one
   * viewer is enough, and a second one would compile its shaders again.
   */
  lend(container: HTMLElement): Viewer {
    this.#lent = true;
    this.#tintPart("");
    container.append(this.#view);
    this.viewer.labels = { styled: "", input: "" };
    this.viewer.setInput(null);
    this.viewer.setPath(null);
    this.viewer.trace = "off";
    this.viewer.setPlanted([false, false]);
    this.viewer.follow = true;
    this.viewer.camera("orbit");
    this.viewer.resetTrail();
    this.invalidate();
    return this.viewer;
  }

  /** Takes the picture back; what it is of has to be shown again. */
  takeBack(): void {
    this.#lent = false;
    this.frozen = false;
    this.element.prepend(this.#view);
    this.viewer.labels = VIEWER_DEFAULTS.labels;
    this.viewer.resetTrail();
  }

  /** Shows on the body which part of it the polygon is of; empty for the whole. */
  #tintPart(part: PlayState["part"]): void {
    this.viewer.tinted = ROLES.filter((role) => partOf(role) === part);
    this.invalidate();
  }

  /** Takes a new frame of the engine. */
  take(frame: LiveFrame): void {
    if (this.#lent) return;
    const { viewer } = this;
    if (frame.looped) viewer.resetTrail();
    viewer.setStyled(frame.pose);
    viewer.setInput(frame.inputPose);
    viewer.setPlanted(frame.planted);
    viewer.pathFrame = frame.inputFrame;
    this.invalidate();
    const now = performance.now();
    if (now - this.#readOutAt < READ_OUT_MS) return;
    this.#readOutAt = now;
    setText(this.#cost, strings.play.perFrame(formatNumber(frame.frameMs, 2)));
  }

  /** A copy of the picture, drawn now or as soon as the graphics processor is ready for it. */
  async picture(): Promise<HTMLCanvasElement> {
    return this.film((pictureAt) => pictureAt(0));
  }

  /**
   * Runs a task while pictures are drawn for it alone: each shows its own time, seconds from the start, however long it
   * takes to draw. They bear no mark of what is being edited.
   * @throws what `signal` was aborted with
   */
  async film<T>(
    task: (pictureAt: (secs: number) => Promise<HTMLCanvasElement>) => Promise<T>,
    signal?: AbortSignal,
  ): Promise<T> {
    const start = performance.now() / 1000;
    const { frozen } = this;
    this.frozen = true;
    this.#tintPart("");
    try {
      return await task(async (secs) => {
        for (;;) {
          signal?.throwIfAborted();
          this.viewer.invalidate();
          if (this.viewer.render(start + secs)) return this.viewer.copy();
          await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
        }
      });
    } finally {
      this.frozen = frozen;
      this.#tintPart(this.#part);
    }
  }

  /** Asks for the picture to be drawn for a while. */
  invalidate(): void {
    this.#drawUntil = performance.now() + AFTERGLOW_MS;
  }

  /** Draws if anything may have changed, and until the viewer has drawn its still picture. */
  draw(now: number): void {
    if (this.frozen) return;
    if (now < this.#drawUntil || !this.viewer.still) this.viewer.render(now / 1000);
  }

  /** Place of a joint in the page, CSS pixels. */
  jointPosition(role: Role): { x: number; y: number } {
    const box = this.#view.getBoundingClientRect();
    const { x, y } = this.viewer.jointScreenPosition(role);
    return { x: box.left + x, y: box.top + y };
  }

  dispose(): void {
    this.viewer.dispose();
  }
}
