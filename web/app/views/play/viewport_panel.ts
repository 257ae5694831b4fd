/** The viewport: the 3-D viewer with title, camera buttons and readouts. */

import "./viewport_panel.css";
import type { LiveFrame, ShownFrame } from "../../../client/protocol";
import { ROLES, type Role } from "../../../humanoid";
import type { CameraPreset } from "../../../link/play";
import { button, Segment } from "../../../ui/controls/buttons";
import { formatNumber, html, setAttributes, setText } from "../../../ui/dom";
import { VIEWER_DEFAULTS } from "../../../viewer";
import type { AppState } from "../../state/state";
import { partOf } from "../../state/style_settings";
import { strings } from "../../strings/strings";
import type { Performing, ViewerLease } from "../../view";

/** Minimum time between updates of readouts, so that they are readable. */
const READ_OUT_MS = 500;

export interface StageListeners {
  onCamera: (preset: CameraPreset) => void;
  onFollow: () => void;
  onGhost: () => void;
  onTrace: () => void;
  /** Called to return to the mannequin. */
  onLeave: () => void;
  /** Called to check the joint mapping of the character. */
  onCheck: () => void;
  /** Called when a joint of the styled character was clicked. */
  onJoint: (joint: Role) => void;
}

/** Before the engine is loaded, there is only one figure. */
const NO_LABELS = { styled: "", input: "" };

/** Largest movement of a click, pixels; a drag turns the camera. */
const CLICK_PX = 4;

export class ViewportPanel {
  readonly element: HTMLElement;
  /** Container for the viewer. */
  readonly picture = html("div");
  readonly #title = html("h1", { class: "stage-title" }, strings.play.before.title);
  readonly #caption = html("p", { class: "caption" }, strings.play.before.caption);
  readonly #camera: Segment<CameraPreset>;
  readonly #follow: HTMLButtonElement;
  readonly #ghost: HTMLButtonElement;
  readonly #trace: HTMLButtonElement;
  /** Name and author of the character in use, and a button to return to the mannequin. */
  readonly #cast: HTMLElement;
  readonly #name = html("span", { class: "cast-name" });
  readonly #check: HTMLButtonElement;
  readonly #credit = html("span", { class: "caption" });
  readonly #fps = html("span");
  readonly #cost = html("span");
  /** The buttons over the picture. */
  readonly controls: HTMLElement;
  readonly #listeners: StageListeners;
  #lease: ViewerLease | undefined;
  #readOutAt = 0;
  /** The last frame of the prelude; `undefined` if none is shown. */
  #preludeFrame: number | undefined;

  constructor(listeners: StageListeners) {
    this.#listeners = listeners;
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
    const back = button(strings.page.characters.back, listeners.onLeave, { icon: "close" });
    this.#check = button(strings.page.characters.check, listeners.onCheck, { label: true });
    this.#cast = html("div", { class: "cast", hidden: true }, this.#name, this.#credit, this.#check, back);
    this.controls = html(
      "div",
      { class: "stage-controls" },
      this.#camera.element,
      this.#follow,
      this.#ghost,
      this.#trace,
    );
    this.element = html(
      "main",
      { class: "stage" },
      this.picture,
      html("div", { class: "stage-heading" }, this.#title, this.#caption),
      this.#cast,
      this.controls,
      html("p", { class: "read-out caption" }, this.#fps, this.#cost, html("span", {}, strings.play.grid)),
    );
    this.#listenToClicks(listeners.onJoint);
  }

  #listenToClicks(onJoint: (joint: Role) => void): void {
    let down: { x: number; y: number } | undefined;
    this.picture.addEventListener("pointerdown", ({ button, clientX: x, clientY: y }) => {
      down = button === 0 ? { x, y } : undefined;
    });
    this.picture.addEventListener("click", ({ clientX: x, clientY: y }) => {
      if (!this.#lease || !down || Math.hypot(x - down.x, y - down.y) > CLICK_PX) return;
      const { viewer, element } = this.#lease;
      const box = element.getBoundingClientRect();
      const joint = viewer.jointAt(x - box.left, y - box.top);
      if (joint) onJoint(joint);
    });
  }

  /** Title and caption over the picture. */
  set heading({ title, caption }: { title: string; caption: string }) {
    setText(this.#title, title);
    setText(this.#caption, caption);
  }

  /** Attaches the viewer; its content is set with {@link show}, {@link path} and {@link draw}. */
  take(lease: ViewerLease): void {
    this.#lease = lease;
    lease.viewer.labels = VIEWER_DEFAULTS.labels;
    lease.viewer.onViewChange = this.#listeners.onCamera;
    lease.viewer.onFps = (fps) => setText(this.#fps, strings.play.fps(Math.round(fps)));
  }

  /** The viewer, while it is attached. */
  get lease(): ViewerLease | undefined {
    return this.#lease;
  }

  /** Detaches the viewer. */
  give(): void {
    this.#lease = undefined;
  }

  /** Shows the fields of the state that concern the picture. */
  show(state: Readonly<AppState>): void {
    this.#camera.value = state.camera;
    this.#follow.setAttribute("aria-pressed", String(state.follow));
    setAttributes(this.#ghost, {
      "aria-pressed": String(state.ghost !== "off"),
      title: `${strings.play.ghost[state.ghost]} (G)`,
    });
    setAttributes(this.#trace, {
      "aria-pressed": String(state.trace !== "off"),
      title: `${strings.play.trail[state.trace]} (T)`,
    });
    if (!this.#lease) return;
    const { viewer } = this.#lease;
    if (viewer.view !== state.camera) viewer.camera(state.camera);
    viewer.follow = state.follow;
    viewer.ghost = state.ghost;
    viewer.motionTrail = state.trace;
    // The body shows which part the polygon refers to.
    this.#lease.tint(ROLES.filter((role) => partOf(role) === state.part));
  }

  /** The character in use; `undefined` for the mannequin. */
  set performing(performing: Performing | undefined) {
    const { viewer, invalidate } = this.#lease ?? {};
    void viewer?.setPerformer(performing?.performer ?? null).then(invalidate);
    this.#cast.hidden = !performing;
    if (!performing) return;
    const { name, credit, url, unsure } = performing;
    this.#check.hidden = !unsure;
    setText(this.#name, name);
    const link = (href: string) => html("a", { href, target: "_blank", rel: "noreferrer" }, credit);
    this.#credit.replaceChildren(url === undefined ? credit : link(url));
  }

  /** Body proportions of the styled character. */
  set proportions(proportions: Float32Array) {
    this.#lease?.viewer.setProportions(proportions);
  }

  /** Pose of an additional translucent body, or none. */
  set other(pose: Float32Array | undefined) {
    this.#lease?.viewer.setOthers(pose ? [{ pose, share: 1 }] : []);
    this.#lease?.invalidate();
  }

  /** Styled poses of the whole input, whose path is drawn. */
  set path(poses: Float32Array | undefined) {
    this.#lease?.viewer.setPath(poses ?? null);
    this.#lease?.invalidate();
  }

  /** Looks at a newly opened motion, which starts facing `heading`, from the same relative direction as before. */
  aim(heading: number): void {
    this.#lease?.viewer.aim(heading);
    this.#lease?.invalidate();
  }

  /** Clears trail and footprints after a jump of the motion. */
  forgetTrail(): void {
    this.#lease?.viewer.resetTrail();
  }

  /** Shows a frame of the prelude, which is not styled. */
  drawPrelude({ pose, inputFrame }: ShownFrame): void {
    if (!this.#lease) return;
    const { viewer } = this.#lease;
    if (this.#preludeFrame === undefined) viewer.labels = NO_LABELS;
    else if (inputFrame < this.#preludeFrame) viewer.resetTrail();
    this.#preludeFrame = inputFrame;
    viewer.setStyled(pose);
    this.#lease.invalidate();
  }

  /** Shows a frame of the engine. */
  draw(frame: LiveFrame): void {
    if (!this.#lease) return;
    const { viewer } = this.#lease;
    if (this.#preludeFrame !== undefined) viewer.labels = VIEWER_DEFAULTS.labels;
    this.#preludeFrame = undefined;
    if (frame.looped) viewer.resetTrail();
    viewer.setStyled(frame.pose);
    viewer.setInput(frame.inputPose);
    viewer.setPlanted(frame.planted);
    viewer.pathFrame = frame.inputFrame;
    this.#lease.invalidate();
    const now = performance.now();
    if (now - this.#readOutAt < READ_OUT_MS) return;
    this.#readOutAt = now;
    setText(this.#cost, strings.play.perFrame(formatNumber(frame.frameMs, 2)));
  }
}
