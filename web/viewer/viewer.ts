/** The 3-D view: a styled character, its input as a ghost, and the ground they walk on. */

import { MathUtils, type Object3D, Vector3 } from "three";
import { DEFAULT_PROPORTIONS, headingOf, isPose, JOINT, type Role, restPose, type WorldPose } from "../humanoid";
import { aboveHead, headOf, jointNear } from "./bones";
import { ClipTrail, type MotionTrailMode } from "./clip_trail";
import { Ghost, type GhostMode } from "./ghost";
import { GhostBodies, type GhostBody } from "./ghost_bodies";
import { Mannequin } from "./mannequin/mannequin";
import { BodyLook } from "./mannequin/materials";
import { Actor, type Performer } from "./performer";
import type { CameraView, Zooming } from "./stage/orbit_camera";
import { Redraw, setPose } from "./stage/redraw";
import type { Screen } from "./stage/screen";
import { Stage } from "./stage/stage";
import { THEMES, type Theme, type ThemeColours, type ThemeName } from "./themes";

/** An additional object on the stage; its creator owns it. */
export interface Prop {
  readonly object: Object3D;
  setTheme(theme: Theme): void;
}

/** Options of a viewer. */
export interface ViewerOptions {
  theme?: ThemeName;
  ghost?: GhostMode;
  /** Whether the camera follows the character. */
  follow?: boolean;
  /** Names above the heads; an empty one is not drawn. */
  labels?: { styled: string; input: string };
  /** Description of the picture for screen readers. */
  description?: string;
  /** Initial level of quality, 0 being the best; by default chosen for the renderer. */
  quality?: number;
  /** The screen to draw on, shared with other viewers; by default a WebGL context of its own. */
  screen?: Screen;
}

/** Defaults of {@link ViewerOptions}. */
export const VIEWER_DEFAULTS: Required<Omit<ViewerOptions, "quality" | "screen">> = {
  theme: "dark",
  ghost: "beside",
  follow: true,
  labels: { styled: "styled", input: "input" },
  description: "A mannequin performing the styled motion, beside a translucent one performing the input.",
};

/** If a new motion's heading differs by less than this, the view does not turn, radians. */
const LEAST_TURN = MathUtils.degToRad(15);
/** Space to the left and right of the subject that the camera follows, metres. */
const HALF_WIDTH = { alone: 0.75, withGhost: 1.15 };

/** A viewer in a container, whose size it follows. The page calls {@link render} once an animation frame. */
export class Viewer {
  readonly #stage: Stage;
  readonly #body: Mannequin<BodyLook>;
  readonly #ghost: Ghost;
  readonly #trail: ClipTrail;
  #theme: ThemeName;
  #colours: Partial<ThemeColours> = {};
  #labels: { styled: string; input: string };
  #planted: [boolean, boolean] = [false, false];
  /** The performer that replaces the mannequin. */
  #actor: Actor | undefined;
  /** The next performer, once it can be drawn. */
  #wanted: Performer | null = null;
  /** The bones on which poses are defined. */
  #proportions: ArrayLike<number> = DEFAULT_PROPORTIONS;
  readonly #styled = restPose();
  /** The clip as given, for the mannequin. */
  #clip: Float32Array | null = null;
  #lastTime: number | undefined;
  readonly #redraw = new Redraw();
  /** The motion's heading at which the camera was aimed, radians. */
  #aimedAt = 0;
  readonly #performedInput = restPose();
  #others: GhostBodies | undefined;
  #prop: Prop | undefined;
  /** Whether the camera follows the character. */
  follow: boolean;
  /** Called after a picture was drawn. */
  onDraw: (() => void) | undefined;

  constructor(container: HTMLElement, options: ViewerOptions = {}) {
    const o = { ...VIEWER_DEFAULTS, ...options };
    this.#theme = o.theme;
    this.#labels = o.labels;
    this.follow = o.follow;
    this.#stage = new Stage(container, { level: options.quality, screen: options.screen });
    const { detail, shading } = this.#stage.quality;
    this.#body = new Mannequin((uniforms) => new BodyLook(uniforms, shading), detail);
    this.#ghost = new Ghost(o.ghost, detail);
    this.#stage.scene.add(this.#body.object, this.#ghost.body.object);
    this.#trail = new ClipTrail(this.#stage);
    this.#stage.onQuality = ({ taps, detail, shading }) => {
      this.#body.look.setQuality(shading, taps);
      this.#body.setDetail(detail);
      this.#ghost.body.setDetail(detail);
      this.#trail.setDetail(detail);
      this.#others?.setDetail(detail);
    };
    this.#stage.onInvalid = () => this.invalidate();
    this.#stage.onIdle = () => this.render(this.#lastTime ?? 0);
    this.#stage.applyQuality();
    this.description = o.description;
    this.#applyTheme();
    this.#applyGhost();
  }

  /** Description of the picture for screen readers. */
  set description(text: string) {
    this.#stage.canvas.setAttribute("aria-label", text);
  }

  /** Id of the element that describes the picture's controls to screen readers. */
  set describedBy(id: string) {
    this.#stage.canvas.setAttribute("aria-describedby", id);
  }

  /** Light or dark; switches at once, without rebuilding anything. */
  get theme(): ThemeName {
    return this.#theme;
  }

  set theme(theme: ThemeName) {
    if (theme === this.#theme) return;
    this.#theme = theme;
    this.#applyTheme();
  }

  /** Position of the ghost. */
  get ghost(): GhostMode {
    return this.#ghost.mode;
  }

  set ghost(mode: GhostMode) {
    if (mode === this.#ghost.mode) return;
    this.#ghost.mode = mode;
    this.#applyGhost();
  }

  /** Whether the ghost is at the right of the picture instead of at the character's right. */
  set ghostByCamera(byCamera: boolean) {
    this.#ghost.byCamera = byCamera;
  }

  /** What is drawn of the moments before and after; it needs the clip of {@link setPath}. */
  get motionTrail(): MotionTrailMode {
    return this.#trail.mode;
  }

  set motionTrail(mode: MotionTrailMode) {
    if (mode === this.#trail.mode) return;
    this.#redraw.request();
    this.#trail.setMode(mode, { theme: this.#themeNow, bones: this.#bones, detail: this.#stage.quality.detail });
    if (this.#actor) this.#applyPath();
  }

  /** The joints of the styled character whose parts are tinted. */
  set tinted(joints: readonly Role[]) {
    this.#redraw.request();
    this.#body.look.tinted = joints;
  }

  /** Names above the heads; an empty one is not drawn. */
  set labels(labels: { styled: string; input: string }) {
    this.#labels = labels;
    this.#applyLabels();
  }

  /** Width of the overlay at the right of the picture, CSS pixels: the character is centred in the rest. */
  set covered(width: number) {
    this.#stage.covered = width;
    this.#redraw.request();
  }

  /** Colours that override the theme's. */
  set colours(colours: Partial<ThemeColours>) {
    this.#colours = colours;
    this.#applyTheme();
  }

  /** Called twice a second with the frames drawn per second. */
  set onFps(callback: ((fps: number) => void) | undefined) {
    this.#stage.onFps = callback;
  }

  /** Called when the user turns a preset view into a free one. */
  set onViewChange(callback: ((view: CameraView) => void) | undefined) {
    this.#stage.view.onViewChange = callback;
  }

  /** Which input zooms; `always` by default. */
  set zooming(zooming: Zooming) {
    this.#stage.view.zooming = zooming;
  }

  /** The current view. */
  get view(): CameraView {
    return this.#stage.view.view;
  }

  /** Whether the picture has been still for a while and its finer version is displayed: there is nothing left to draw. */
  get still(): boolean {
    return this.#stage.still && !this.#redraw.pending;
  }

  /** Triangles and draw calls of the last frame. */
  get cost(): { triangles: number; calls: number } {
    return this.#stage.cost;
  }

  /** Sets the bone offsets of the body on which poses are defined: 21 × xyz, metres; see `web/mannequin/fit.ts`. */
  setProportions(proportions: ArrayLike<number>): void {
    this.#proportions = proportions;
    this.#actor?.setBody(proportions);
    this.#applyBody();
  }

  /**
   * Makes a rigged character perform in place of the mannequin, or the mannequin again (`null`). The mannequin performs
   * until the character's materials are compiled. The ghost is a mannequin of the same body. The caller owns the
   * character and may free it once another one was set.
   */
  async setPerformer(performer: Performer | null): Promise<void> {
    if (performer === this.#wanted) return;
    this.#wanted = performer;
    if (this.#actor) this.#cast(undefined);
    if (!performer) return;
    const actor = new Actor(performer);
    await this.#stage.prepare(performer.object);
    if (performer === this.#wanted) this.#cast(actor);
  }

  /** Sets the styled pose, `POSE_FLOATS` numbers; a pose with a number that is not finite is ignored. */
  setStyled(pose: ArrayLike<number>): void {
    if (!isPose(pose)) return;
    setPose(this.#styled, pose, this.#redraw);
    this.#pose();
  }

  /** Sets the input's pose, or `null` if there is none. */
  setInput(pose: ArrayLike<number> | null): void {
    if (this.#ghost.setInput(pose && isPose(pose) ? pose : null, this.#redraw)) this.#applyGhost();
  }

  /** Sets translucent bodies at the positions of their poses; labels and camera ignore them. */
  setOthers(others: readonly GhostBody[]): void {
    this.#redraw.request();
    if (!this.#others) {
      if (others.length === 0) return;
      this.#others = new GhostBodies(this.#themeNow, this.#bones, this.#stage.quality.detail);
      this.#stage.scene.add(this.#others.object);
    }
    this.#others.set(others);
  }

  /** Adds an object to the stage once it can be drawn, replacing the previous one. */
  async setProp(prop: Prop | undefined): Promise<void> {
    if (this.#prop) this.#stage.scene.remove(this.#prop.object);
    this.#prop = prop;
    this.#redraw.request();
    if (!prop) return;
    prop.setTheme(this.#themeNow);
    await this.#stage.compileObject(prop.object);
    if (prop !== this.#prop) return;
    this.#stage.scene.add(prop.object);
    this.#redraw.request();
  }

  /** Sets which feet of the styled character are planted; a planted foot leaves a footprint. */
  setPlanted(planted: readonly [left: boolean, right: boolean]): void {
    if (planted[0] !== this.#planted[0] || planted[1] !== this.#planted[1]) this.#redraw.request();
    this.#planted = [...planted];
  }

  /** Sets the styled poses of the whole clip, whose path ahead of {@link pathFrame} is drawn; `null` draws none. */
  setPath(poses: Float32Array | null): void {
    this.#clip = poses;
    this.#applyPath();
  }

  /** Fractional frame of the path's clip that is displayed. */
  set pathFrame(frame: number) {
    this.#trail.frame = frame;
  }

  /** Clears trail and footprints and places the camera and the ghost again: after a seek or when a clip loops. */
  resetTrail(): void {
    this.#redraw.request();
    this.#stage.footprints.clear();
    this.#stage.path.clear();
    if (this.follow) this.#stage.view.settle();
    this.#ghost.reset();
    this.#actor?.performer.settle();
  }

  /** Moves to a view, with a glide; the side view is from the left, or from the right. */
  camera(view: CameraView, fromRight = false): void {
    this.#stage.setView(view, headingOf(this.#world, 0) + (fromRight ? Math.PI : 0));
  }

  /**
   * Looks at the character at its current position, whether or not it is followed, from the same relative direction as
   * before. Called when another motion begins, which faces `heading`, radians about +Y.
   */
  aim(heading: number): void {
    const turned = heading - this.#aimedAt;
    if (Math.abs(Math.atan2(Math.sin(turned), Math.cos(turned))) > LEAST_TURN) {
      this.#stage.view.turn(turned);
      this.#aimedAt = heading;
    }
    this.#stage.view.settle();
    this.#redraw.request();
  }

  /** Moves behind the character, with a glide, to a view of the ground ahead, and looks at it whether or not it is followed. */
  cameraBehind(): void {
    // The ghost changes sides during the glide.
    this.#stage.view.settle();
    this.#stage.setBehind(headingOf(this.#world, 0));
  }

  /** Position of a joint of the styled character in the picture, CSS pixels from the canvas's top left. */
  jointScreenPosition(role: Role): { x: number; y: number } {
    return this.#stage.project(point.fromArray(this.#world.positions, 3 * JOINT[role]));
  }

  /** The joints of the styled character in the world; callers must not keep the object. */
  get joints(): Readonly<WorldPose> {
    return this.#world;
  }

  /** Direction in which the camera looks: a unit vector of the world. */
  get lineOfSight(): readonly [x: number, y: number, z: number] {
    const { x, y, z } = this.#stage.view.camera.getWorldDirection(point);
    return [x, y, z];
  }

  /** Position of a point of the world in the picture, CSS pixels from the canvas's top left. */
  screenPosition(x: number, y: number, z: number): { x: number; y: number } {
    return this.#stage.project(point.set(x, y, z));
  }

  /** The point on the ground under a point of the picture, metres; `undefined` above the horizon. */
  groundAt(x: number, y: number): { x: number; z: number } | undefined {
    return this.#stage.groundAt(x, y);
  }

  /** The joint of the styled character whose bone is at a point of the picture, CSS pixels; `undefined` if there is none. */
  jointAt(x: number, y: number): Role | undefined {
    return jointNear(x, y, (role) => this.jointScreenPosition(role));
  }

  /**
   * Draws a frame, unless earlier frames are still being drawn; `timeSecs` is any clock, whose backward steps are
   * ignored. A picture that has not changed for a while is drawn once more with more pixels, and then not again.
   * Returns whether it was drawn.
   */
  render(timeSecs: number): boolean {
    const dt = Math.max(0, timeSecs - (this.#lastTime ?? timeSecs));
    this.#lastTime = timeSecs;
    this.#actor?.performer.update(dt);
    this.#arrange(dt);
    const stage = this.#stage;
    const centre = followed.copy(hips);
    if (this.#ghost.isBeside) centre.lerp(this.#ghost.hips, 0.5);
    const moved = stage.view.update(dt, centre, this.follow);
    if (moved) this.#redraw.request();
    const still = this.#redraw.settled(timeSecs);
    if ((still && stage.still) || !stage.begin(dt, still)) return false;
    this.#redraw.drawn();
    stage.render(hips);
    stage.end();
    const { width, height } = stage.size;
    const { camera } = stage.view;
    const { rise, radius } = this.#actor?.head ?? headOf(this.#body.fit);
    stage.labels.place("styled", aboveHead(this.#world, rise), radius, camera, width, height);
    const { fit, world } = this.#ghost.body;
    const head = headOf(fit);
    stage.labels.place("input", aboveHead(world, head.rise), head.radius, camera, width, height);
    this.onDraw?.();
    return true;
  }

  /** Requests a redraw, although nothing has changed. */
  invalidate(): void {
    this.#redraw.request();
  }

  /** Size of exported pictures, pixels; `undefined` for the displayed size. */
  set filmed(size: { readonly width: number; readonly height: number } | undefined) {
    this.#stage.filmed = size;
    this.#redraw.request();
  }

  /** A copy of the picture; valid only right after {@link render} has drawn it, in the same task. */
  copy(): HTMLCanvasElement {
    return this.#stage.copy();
  }

  /** Frees all resources; the viewer cannot be used afterwards. */
  dispose(): void {
    this.#wanted = null;
    this.#dismiss();
    this.#body.dispose();
    this.#ghost.body.dispose();
    this.#trail.dispose();
    this.#others?.dispose();
    this.#stage.dispose();
  }

  #cast(actor: Actor | undefined): void {
    this.#dismiss();
    this.#actor = actor;
    if (actor) {
      actor.setBody(this.#proportions);
      this.#stage.scene.add(actor.performer.object);
    }
    this.#body.object.visible = !actor;
    this.#stage.view.scale = actor?.scale ?? 1;
    this.#ghost.scale = actor?.scale ?? 1;
    this.#applyBody();
    this.resetTrail();
  }

  /** Removes the performer from the stage, unless another viewer has taken it over. */
  #dismiss(): void {
    if (this.#actor) this.#stage.scene.remove(this.#actor.performer.object);
  }

  /** The joints of the styled character in the world. */
  get #world(): WorldPose {
    return this.#actor?.world ?? this.#body.world;
  }

  /** The bones of the body that performs. */
  get #bones(): ArrayLike<number> {
    return this.#actor?.proportions ?? this.#proportions;
  }

  /** The current pose of the styled character, on its own body. */
  get #held(): ArrayLike<number> {
    return this.#actor?.performer.pose ?? this.#body.pose;
  }

  /** Applies the styled character's pose. */
  #pose(): void {
    if (this.#actor) this.#actor.perform(this.#styled);
    else this.#body.setPose(this.#styled);
  }

  /** Fits everything to the body that performs. */
  #applyBody(): void {
    this.#redraw.request();
    for (const mannequin of [this.#body, this.#ghost.body]) mannequin.setProportions(this.#bones);
    this.#trail.setProportions(this.#bones);
    this.#others?.setProportions(this.#bones);
    this.#pose();
    this.#applyPath();
  }

  /** Computes the clip's path and trail for the body that performs it. */
  #applyPath(): void {
    this.#redraw.request();
    let clip = this.#clip;
    if (clip && this.#actor) {
      // Hands and feet are only needed for the trail.
      clip = this.#trail.mode === "off" ? this.#actor.travelling(clip) : this.#actor.performed(clip);
      this.#pose();
    }
    this.#trail.setClip(clip, this.#actor?.proportions ?? this.#body.fit.proportions);
  }

  /** Updates everything on the ground to the current poses. */
  #arrange(dtSecs: number): void {
    const world = this.#world;
    const stature = this.#actor?.stature ?? this.#body.fit.stature;
    const { shade, footprints, path } = this.#stage;
    hips.fromArray(world.positions, 0);
    shade.setOccluder("body", world, stature);
    footprints.update(this.#planted, world);
    footprints.draw(dtSecs, stature);
    path.push(hips.x, hips.z);
    path.draw(hips.x, hips.z, this.#trail.frame, this.#trail.turnTo(this.#held));
    this.#trail.draw(this.#held, hips);
    this.#placeGhost(dtSecs);
  }

  #applyTheme(): void {
    const theme = this.#themeNow;
    this.#body.look.setTheme(theme);
    this.#ghost.body.look.setTheme(theme);
    this.#stage.setTheme(theme);
    this.#trail.setTheme(theme);
    this.#others?.setTheme(theme);
    this.#prop?.setTheme(theme);
    this.#applyLabels();
  }

  #applyGhost(): void {
    this.#stage.view.halfWidth = this.#ghost.isBeside ? HALF_WIDTH.withGhost : HALF_WIDTH.alone;
    this.#applyLabels();
  }

  get #themeNow(): Theme {
    return { ...THEMES[this.#theme], ...this.#colours };
  }

  #applyLabels(): void {
    this.#redraw.request();
    const theme = this.#themeNow;
    this.#stage.labels.set("styled", this.#labels.styled, theme.ink);
    this.#stage.labels.set("input", this.#ghost.isBeside ? this.#labels.input : "", theme.input);
  }

  /** The input's pose on the body that performs. */
  #inputOnBody(): ArrayLike<number> {
    if (!this.#actor) return this.#ghost.input;
    this.#actor.perform(this.#ghost.input);
    this.#performedInput.set(this.#actor.performer.pose);
    this.#pose();
    return this.#performedInput;
  }

  #placeGhost(dtSecs: number): void {
    const ghost = this.#ghost;
    if (ghost.isVisible) ghost.place(this.#inputOnBody(), this.#world, this.#stage.view.azimuth);
    ghost.fadeIn(dtSecs);
    this.#stage.shade.setOccluder("ghost", ghost.isBeside ? ghost.body.world : null, ghost.body.fit.stature);
  }
}

const point = new Vector3();
const hips = new Vector3();
const followed = new Vector3();
