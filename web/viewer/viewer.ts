/** The 3-D view: a styled character, its input as a ghost, and the ground they walk on. */

import { MathUtils, type Object3D, Quaternion, Vector3 } from "three";
import {
  DEFAULT_PROPORTIONS,
  headingOf,
  hipsTurn,
  isPose,
  JOINT,
  POSE_FLOATS,
  type Role,
  restPose,
  type WorldPose,
} from "../humanoid";
import { GhostBodies, type GhostBody } from "./ghost_bodies";
import { GhostPlacement } from "./ghost_placement";
import { Mannequin } from "./mannequin/mannequin";
import { BodyLook, GhostLook } from "./mannequin/materials";
import { OnionSkin } from "./onion_skin";
import { Actor, type Performer } from "./performer";
import { MotionTrail } from "./stage/motion_trail";
import type { CameraView, Zooming } from "./stage/orbit_camera";
import { Redraw } from "./stage/redraw";
import type { Screen } from "./stage/screen";
import { Stage } from "./stage/stage";
import { THEMES, type Theme, type ThemeColours, type ThemeName } from "./themes";

/** Position of the input's ghost: at the character's right, at the character's position and behind it, or none. */
export type GhostMode = "beside" | "overlay" | "off";

/** What is drawn of the moments before and after: nothing, lines of hands, feet and head, or whole bodies as well. */
export type MotionTrailMode = "off" | "lines" | "onion";

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

/** Duration of the ghost's fade-in after it was placed again, seconds. */
const FADE_IN = 0.25;
/** Middle of the head above its joint, and its radius, metres. */
const HEAD = { rise: 0.088, radius: 0.122 };
/** Bones that can be clicked: the joint that rotates each one, and its ends. */
const BONES: readonly [Role, Role, Role][] = [
  ["hips", "hips", "hips"],
  ["spine", "spine", "chest"],
  ["chest", "chest", "neck"],
  ["head", "neck", "head"],
  ...(["left", "right"] as const).flatMap((side): [Role, Role, Role][] => [
    [`${side}_upper_arm`, `${side}_upper_arm`, `${side}_lower_arm`],
    [`${side}_lower_arm`, `${side}_lower_arm`, `${side}_hand`],
    [`${side}_hand`, `${side}_hand`, `${side}_hand`],
    [`${side}_upper_leg`, `${side}_upper_leg`, `${side}_lower_leg`],
    [`${side}_lower_leg`, `${side}_lower_leg`, `${side}_foot`],
    [`${side}_foot`, `${side}_foot`, `${side}_toes`],
  ]),
];
/** A click within this distance of a bone hits it, however small the character is. */
const MIN_REACH_PX = 10;
/** If a new motion's heading differs by less than this, the view does not turn, radians. */
const LEAST_TURN = MathUtils.degToRad(15);
/** Space to the left and right of the subject that the camera follows, metres. */
const HALF_WIDTH = { alone: 0.75, withGhost: 1.15 };

/** A viewer in a container, whose size it follows. The page calls {@link render} once an animation frame. */
export class Viewer {
  readonly #stage: Stage;
  readonly #body: Mannequin<BodyLook>;
  readonly #ghost: Mannequin<GhostLook>;
  #theme: ThemeName;
  #colours: Partial<ThemeColours> = {};
  #ghostMode: GhostMode;
  #labels: { styled: string; input: string };
  #hasInput = false;
  #planted: [boolean, boolean] = [false, false];
  /** The performer that replaces the mannequin. */
  #actor: Actor | undefined;
  /** The next performer, once it can be drawn. */
  #wanted: Performer | null = null;
  /** The bones on which poses are defined. */
  #proportions: ArrayLike<number> = DEFAULT_PROPORTIONS;
  readonly #styled = restPose();
  /** The clip as given, and on the body that performs it. */
  #given: Float32Array | null = null;
  #clip: Float32Array | null = null;
  #pathFrame = 0;
  #lastTime: number | undefined;
  readonly #redraw = new Redraw();
  readonly #placement = new GhostPlacement();
  /** The motion's heading at which the camera was aimed, radians. */
  #aimedAt = 0;
  readonly #input = restPose();
  readonly #performedInput = restPose();
  readonly #trail = new MotionTrail();
  #onion: OnionSkin | undefined;
  #others: GhostBodies | undefined;
  #motionTrail: MotionTrailMode = "off";
  #ghostFade = 1;
  #prop: Prop | undefined;
  /** Whether the ghost is at the right of the picture instead of at the character's right. */
  ghostByCamera = false;
  /** Whether the camera follows the character. */
  follow: boolean;
  /** Called after a picture was drawn. */
  onDraw: (() => void) | undefined;

  constructor(container: HTMLElement, options: ViewerOptions = {}) {
    const o = { ...VIEWER_DEFAULTS, ...options };
    this.#theme = o.theme;
    this.#ghostMode = o.ghost;
    this.#labels = o.labels;
    this.follow = o.follow;
    this.#stage = new Stage(container, { level: options.quality, screen: options.screen });
    const { detail, shading } = this.#stage.quality;
    this.#body = new Mannequin((uniforms) => new BodyLook(uniforms, shading), detail);
    this.#ghost = new Mannequin((uniforms) => new GhostLook(uniforms), detail);
    this.#stage.scene.add(this.#body.object, this.#ghost.object, this.#trail.object);
    this.#stage.onQuality = ({ taps, detail, shading }) => {
      this.#body.look.setQuality(shading, taps);
      this.#body.setDetail(detail);
      this.#ghost.setDetail(detail);
      this.#onion?.setDetail(detail);
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
    return this.#ghostMode;
  }

  set ghost(mode: GhostMode) {
    if (mode === this.#ghostMode) return;
    this.#ghostMode = mode;
    this.#applyGhost();
  }

  /** What is drawn of the moments before and after; it needs the clip of {@link setPath}. */
  get motionTrail(): MotionTrailMode {
    return this.#motionTrail;
  }

  set motionTrail(mode: MotionTrailMode) {
    if (mode === this.#motionTrail) return;
    this.#motionTrail = mode;
    this.#redraw.request();
    this.#trail.object.visible = mode !== "off";
    if (this.#actor) this.#applyPath();
    this.#onion?.dispose();
    this.#onion = undefined;
    if (mode !== "onion") return;
    this.#onion = new OnionSkin(this.#themeNow, this.#bones, this.#stage.quality.detail);
    this.#stage.scene.add(this.#onion.object);
    void this.#stage.compile();
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
    if (differ(pose, this.#styled)) this.#redraw.request();
    this.#styled.set(pose);
    this.#pose();
  }

  /** Sets the input's pose, or `null` if there is none. */
  setInput(pose: ArrayLike<number> | null): void {
    const has = pose !== null && isPose(pose);
    if (has) {
      if (differ(pose, this.#input)) this.#redraw.request();
      this.#input.set(pose);
    }
    if (has === this.#hasInput) return;
    this.#hasInput = has;
    this.#applyGhost();
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
    this.#given = poses;
    this.#applyPath();
  }

  /** Fractional frame of the path's clip that is displayed. */
  set pathFrame(frame: number) {
    this.#pathFrame = frame;
  }

  /** Clears trail and footprints and places the camera and the ghost again: after a seek or when a clip loops. */
  resetTrail(): void {
    this.#redraw.request();
    this.#stage.footprints.clear();
    this.#stage.path.clear();
    if (this.follow) this.#stage.view.settle();
    this.#placement.reset();
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
    let nearest: { role: Role; distance: number } | undefined;
    for (const [bone, from, to] of BONES) {
      const [a, b] = [this.jointScreenPosition(from), this.jointScreenPosition(to)];
      const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
      const along = MathUtils.clamp(((x - a.x) * (b.x - a.x) + (y - a.y) * (b.y - a.y)) / length ** 2, 0, 1);
      const distance = Math.hypot(x - a.x - along * (b.x - a.x), y - a.y - along * (b.y - a.y));
      if (!nearest || distance < nearest.distance) nearest = { role: bone, distance };
    }
    // The trunk is half as wide as it is long.
    const [neck, hips] = [this.jointScreenPosition("neck"), this.jointScreenPosition("hips")];
    const reach = Math.max(MIN_REACH_PX, Math.hypot(neck.x - hips.x, neck.y - hips.y) / 4);
    return nearest && nearest.distance <= reach ? nearest.role : undefined;
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
    if (this.#ghost.object.visible && this.#ghostMode === "beside") centre.lerp(ghostHips, 0.5);
    const moved = stage.view.update(dt, centre, this.follow);
    if (moved) this.#redraw.request();
    const still = this.#redraw.settled(timeSecs);
    if ((still && stage.still) || !stage.begin(dt, still)) return false;
    this.#redraw.drawn();
    stage.render(hips);
    stage.end();
    const { width, height } = stage.size;
    const { camera } = stage.view;
    const { rise, radius } = this.#actor?.head ?? headOf(this.#body);
    stage.labels.place("styled", above(this.#world, rise), radius, camera, width, height);
    const ghost = headOf(this.#ghost);
    stage.labels.place("input", above(this.#ghost.world, ghost.rise), ghost.radius, camera, width, height);
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
    this.#ghost.dispose();
    this.#trail.dispose();
    this.#onion?.dispose();
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
    this.#placement.scale = actor?.scale ?? 1;
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
    for (const mannequin of [this.#body, this.#ghost]) mannequin.setProportions(this.#bones);
    this.#onion?.setProportions(this.#bones);
    this.#others?.setProportions(this.#bones);
    this.#pose();
    this.#applyPath();
  }

  /** Computes the clip's path and trail for the body that performs it. */
  #applyPath(): void {
    this.#redraw.request();
    const given = this.#given;
    this.#clip = given;
    if (given && this.#actor) {
      // Hands and feet are only needed for the trail.
      const isTraced = this.#motionTrail !== "off";
      this.#clip = isTraced ? this.#actor.performed(given) : this.#actor.travelling(given);
      this.#pose();
    }
    this.#stage.path.setClip(this.#clip);
    this.#trail.setClip(this.#clip, this.#actor?.proportions ?? this.#body.fit.proportions);
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
    path.draw(hips.x, hips.z, this.#pathFrame, this.#pathTurn());
    this.#drawMotionTrail();
    this.#placeGhost(dtSecs);
  }

  #applyTheme(): void {
    const theme = this.#themeNow;
    this.#body.look.setTheme(theme);
    this.#ghost.look.setTheme(theme);
    this.#stage.setTheme(theme);
    this.#trail.setTheme(theme);
    this.#onion?.setTheme(theme);
    this.#others?.setTheme(theme);
    this.#prop?.setTheme(theme);
    this.#applyLabels();
  }

  #applyGhost(): void {
    const mode = this.#hasInput ? this.#ghostMode : "off";
    this.#ghost.object.visible = mode !== "off";
    this.#ghost.look.behindBodies = mode === "overlay";
    this.#placement.reset();
    this.#stage.view.halfWidth = mode === "beside" ? HALF_WIDTH.withGhost : HALF_WIDTH.alone;
    this.#applyLabels();
  }

  get #themeNow(): Theme {
    return { ...THEMES[this.#theme], ...this.#colours };
  }

  #applyLabels(): void {
    this.#redraw.request();
    const theme = this.#themeNow;
    const beside = this.#hasInput && this.#ghostMode === "beside";
    this.#stage.labels.set("styled", this.#labels.styled, theme.ink);
    this.#stage.labels.set("input", beside ? this.#labels.input : "", theme.input);
  }

  /** Rotation from the clip's heading at its frame to the character's. */
  #pathTurn(): number {
    const clip = this.#clip;
    if (!clip) return 0;
    const frame = MathUtils.clamp(Math.round(this.#pathFrame), 0, clip.length / POSE_FLOATS - 1);
    return hipsTurn(this.#held) - hipsTurn(clip, frame);
  }

  /** Draws the moments before and after the character's current frame, from the clip. */
  #drawMotionTrail(): void {
    const clip = this.#clip;
    if (this.#motionTrail === "off" || !clip) return;
    const turn = this.#pathTurn();
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    const frames = clip.length / POSE_FLOATS;
    const at = MathUtils.clamp(this.#pathFrame, 0, frames - 1);
    const [i, t] = [Math.floor(at), at - Math.floor(at)];
    const root = (axis: 0 | 2) => {
      const a = clip[i * POSE_FLOATS + axis]!;
      return a + (clip[Math.min(i + 1, frames - 1) * POSE_FLOATS + axis]! - a) * t;
    };
    const [x, z] = [root(0), root(2)];
    const placement = { turn, x: hips.x - c * x - s * z, z: hips.z - c * z + s * x };
    this.#trail.draw(this.#pathFrame, placement);
    this.#onion?.place(clip, this.#pathFrame, placement);
  }

  /** The input's pose on the body that performs. */
  #inputOnBody(): ArrayLike<number> {
    if (!this.#actor) return this.#input;
    this.#actor.perform(this.#input);
    this.#performedInput.set(this.#actor.performer.pose);
    this.#pose();
    return this.#performedInput;
  }

  #placeGhost(dtSecs: number): void {
    const visible = this.#ghost.object.visible;
    if (visible) {
      this.#placement.facing = this.ghostByCamera ? this.#stage.view.azimuth + Math.PI : undefined;
      const again = this.#placement.place(
        this.#inputOnBody(),
        this.#ghost.fit.proportions,
        this.#world,
        this.#ghostMode === "beside",
      );
      if (again) this.#ghostFade = 0;
      this.#ghost.setPose(this.#placement.pose);
      ghostHips.fromArray(this.#ghost.world.positions, 0);
    }
    if (this.#ghostFade < 1) {
      this.#ghostFade = Math.min(1, this.#ghostFade + dtSecs / FADE_IN);
      this.#ghost.look.fade = this.#ghostFade;
    }
    const shaded = visible && this.#ghostMode === "beside";
    this.#stage.shade.setOccluder("ghost", shaded ? this.#ghost.world : null, this.#ghost.fit.stature);
  }
}

const point = new Vector3();
const hips = new Vector3();
const ghostHips = new Vector3();
const followed = new Vector3();
const head = new Vector3();
const rotation = new Quaternion();

/** Whether any number differs. */
function differ(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  for (let i = 0; i < a.length; i++) if (Math.fround(a[i]!) !== b[i]) return true;
  return false;
}

/** Middle of a mannequin's head above its joint, and its radius, metres. */
function headOf({ fit }: Mannequin<BodyLook> | Mannequin<GhostLook>): { rise: number; radius: number } {
  return { rise: HEAD.rise * fit.stature, radius: HEAD.radius * fit.stature };
}

/** The middle of a head, `rise` metres above its joint. */
function above({ positions, rotations }: WorldPose, rise: number): Vector3 {
  rotation.fromArray(rotations, 4 * JOINT.head);
  return head
    .set(0, rise, 0)
    .applyQuaternion(rotation)
    .add(point.fromArray(positions, 3 * JOINT.head));
}
