/** The 3-D view of a crowd: up to a thousand walkers on a ground that shows a map of styles. */

import { Fog, MathUtils, Vector3 } from "three";
import { CROWD_WALKER_FLOATS, DEFAULT_PROPORTIONS } from "../../humanoid";
import { fitTo } from "../../mannequin/fit";
import { prismBodies } from "../../mannequin/prism_body";
import { keyDirection } from "../light/lights";
import type { CameraRange, CameraView } from "../stage/orbit_camera";
import { Redraw } from "../stage/redraw";
import { Stage } from "../stage/stage";
import { THEMES, type ThemeName } from "../themes";
import { CrowdBodies } from "./crowd_bodies";
import { FieldGround, type FieldMark } from "./field_ground";
import { GroundNames } from "./ground_names";
import { JointTextures } from "./joint_textures";
import { BODY_LIMITS, BodyLevels, type BodyLimits } from "./levels";
import { CrowdShadows } from "./shadows";

/** A vertex of the field with its name. */
interface NamedMark extends FieldMark {
  name: string;
}

/** A point in the picture, CSS pixels from its top left. */
interface ScreenPlace {
  x: number;
  y: number;
}

const RANGE: CameraRange = {
  home: { azimuth: MathUtils.degToRad(16), elevation: MathUtils.degToRad(17), distance: 19 },
  distances: [3, 90],
  far: 220,
};
/** Half the width that must fit into the home view, metres. */
const HALF_WIDTH = 4.6;
/**
 * Distance of the top view from which most of the ground is visible, in radii of the ground, and the largest distance,
 * metres.
 */
const ABOVE = 3.4;
const HIGHEST = 80;
/** Half-life of the camera's approach to the walker that it follows, or back, seconds. */
const FOLLOW_HALF_LIFE = 0.16;
/** Below this distance the camera has arrived, metres. */
const ARRIVED = 1e-3;
/** Height of a walker, metres. */
const HEIGHT = 1.7;
/** Radius of the ring around the selected walker, metres. */
const RING = 0.55;
/** Within this distance of the pointer a walker is hit, however small it is, CSS pixels. */
const REACH_PX = 13;
/**
 * Which walkers have the finer bodies, and the minimum height, as a share of the picture's, of walkers whose shadow is an
 * outline.
 */
interface Limits {
  bodies: BodyLimits;
  outlined: number;
}
const LIMITS: Limits = { bodies: BODY_LIMITS, outlined: 0.05 };
/** The limits without a GPU, for a still picture and for a moving one. */
const STILL: Limits = { bodies: { near: { height: 220, count: 0 }, middle: { height: 90, count: 8 } }, outlined: 0.14 };
const MOVING: Limits = {
  bodies: { near: { height: 220, count: 0 }, middle: { height: 150, count: 3 } },
  outlined: 0.2,
};

/** The bones on which all walkers are drawn, from those of the motion, because joints must lie on them. 21 × xyz, metres. */
export function drawnBones(proportions: ArrayLike<number>): Float32Array {
  return fitTo(proportions).proportions;
}

/** A viewer in a container, whose size it follows. The page calls {@link render} once an animation frame. */
export class CrowdViewer {
  readonly #stage: Stage;
  readonly #textures = new JointTextures();
  readonly #bodies: CrowdBodies;
  readonly #shadows: CrowdShadows;
  readonly #ground = new FieldGround();
  readonly #names = new GroundNames();
  readonly #fog = new Fog("#000000");
  readonly #redraw = new Redraw();
  #theme: ThemeName;
  #marks: readonly NamedMark[] = [];
  #levels = new BodyLevels(0);
  #heights = new Float32Array(0);
  /** Joints of the last tick and of the current one. */
  #last = new Float32Array(0);
  #present = new Float32Array(0);
  #radius = 10;
  #lastTime: number | undefined;
  /** The selected walker. */
  #chosen: number | undefined;
  /** The point at which the camera looks: the middle, a walker, or between them. */
  readonly #focus = new Vector3();
  /** Whether the camera follows the selected walker. */
  follow = false;

  constructor(container: HTMLElement, theme: ThemeName, description: string) {
    this.#theme = theme;
    this.#stage = new Stage(container, { camera: RANGE, bare: true });
    this.#stage.canvas.setAttribute("aria-label", description);
    this.#stage.view.halfWidth = HALF_WIDTH;
    const { detail, shading } = this.#stage.quality;
    const fit = fitTo(DEFAULT_PROPORTIONS);
    const { seen, outline } = prismBodies(fit);
    this.#bodies = new CrowdBodies(this.#textures, fit, seen, detail, shading);
    this.#shadows = new CrowdShadows(this.#textures, outline);
    const { scene } = this.#stage;
    scene.add(this.#ground.object, this.#names.object, this.#shadows.object, this.#bodies.object);
    scene.fog = this.#fog;
    this.#stage.onQuality = ({ detail, shading }) => this.#bodies.setQuality(detail, shading);
    this.#stage.onInvalid = () => this.#redraw.request();
    this.#stage.onIdle = () => this.render(this.#lastTime ?? 0, this.#textures.uniforms.share.value);
    this.#stage.applyQuality();
    this.#applyTheme();
  }

  /** Description of the picture for screen readers. */
  set description(text: string) {
    this.#stage.canvas.setAttribute("aria-label", text);
  }

  /** Light or dark. */
  set theme(theme: ThemeName) {
    if (theme === this.#theme) return;
    this.#theme = theme;
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

  /** Triangles and draw calls of the last frame. */
  get cost(): { triangles: number; calls: number } {
    return this.#stage.cost;
  }

  /** Name of the renderer as reported by the browser. */
  get drawnBy(): string {
    return this.#stage.drawnBy;
  }

  /** Direction from which the camera looks, radians about +Y from +Z. */
  get azimuth(): number {
    return this.#stage.view.azimuth;
  }

  /** Whether there is nothing left to draw. */
  get still(): boolean {
    return this.#stage.still && !this.#redraw.pending;
  }

  /** The selected walker, marked by a ring. */
  set chosen(walker: number | undefined) {
    this.#chosen = walker;
    this.#redraw.request();
  }

  /** Sets the bone offsets of all walkers: 21 × xyz, metres. */
  setProportions(proportions: ArrayLike<number>): void {
    const fit = fitTo(proportions);
    const { seen, outline } = prismBodies(fit);
    this.#bodies.setBody(fit, seen);
    this.#shadows.setBody(outline);
    this.#redraw.request();
  }

  /** Sets the field, and the radius in which agents walk, metres. */
  setField(marks: readonly NamedMark[], radius: number): void {
    this.#marks = marks;
    this.#radius = radius;
    this.#stage.view.above = Math.min(HIGHEST, ABOVE * radius);
    this.#applyField();
  }

  /**
   * Sets a tick: `CROWD_WALKER_FLOATS` numbers per walker, and four bytes of tint (sRGB, and its share). `isOther`
   * means that these are not the walkers of the last tick.
   */
  setTick(joints: Float32Array, tints: Uint8Array, isOther: boolean): void {
    const count = joints.length / CROWD_WALKER_FLOATS;
    if (count !== this.#levels.walkers.far.length) {
      this.#levels = new BodyLevels(count);
      this.#heights = new Float32Array(count);
      this.#last = new Float32Array(joints.length);
      this.#present = new Float32Array(joints.length);
      isOther = true;
    }
    [this.#last, this.#present] = [this.#present, this.#last];
    this.#present.set(joints);
    if (isOther) this.#last.set(joints);
    this.#textures.set(joints, tints, isOther);
    this.#redraw.request();
  }

  /** Moves to a view, with a glide. */
  camera(view: CameraView): void {
    this.#stage.setView(view, 0);
    this.#redraw.request();
  }

  /**
   * Draws a frame at `share` between the last tick and the current one, unless earlier frames are still being drawn.
   * `timeSecs` is any clock; `fine` asks for the finer picture of a still scene. Returns whether it was drawn.
   */
  render(timeSecs: number, share: number, fine = false): boolean {
    const dt = Math.max(0, timeSecs - (this.#lastTime ?? timeSecs));
    this.#lastTime = timeSecs;
    const { uniforms } = this.#textures;
    if (uniforms.share.value !== share) this.#redraw.request();
    uniforms.share.value = share;
    const chosen = this.#chosen;
    const at = chosen === undefined ? middle.set(0, 0, 0) : this.#hips(chosen, middle);
    this.#moveFocus(this.follow && chosen !== undefined ? at : origin, dt);
    if (this.#stage.view.update(dt, this.#focus, true)) this.#redraw.request();
    this.#ground.setRing(chosen === undefined ? undefined : { x: at.x, z: at.z, radius: RING });
    const still = fine || this.#redraw.settled(timeSecs);
    if ((still && this.#stage.still && !fine) || !this.#stage.begin(dt, still, fine)) return false;
    this.#redraw.drawn();
    this.#arrange();
    this.#stage.render(this.#stage.view.target);
    this.#stage.end();
    return true;
  }

  /** A copy of the picture; valid only right after {@link render} has drawn it, in the same task. */
  copy(): HTMLCanvasElement {
    return this.#stage.copy();
  }

  /** Requests a redraw, although nothing has changed. */
  invalidate(): void {
    this.#redraw.request();
  }

  /** Position of a point of the world in the picture, CSS pixels from its top left; `undefined` behind the camera. */
  screenPosition(x: number, y: number, z: number): ScreenPlace | undefined {
    const { camera } = this.#stage.view;
    const isBehind = point.set(x, y, z).applyMatrix4(camera.matrixWorldInverse).z > -camera.near;
    return isBehind ? undefined : this.#stage.project(point.set(x, y, z));
  }

  /** The point on the ground under a point of the picture, metres; `undefined` above the horizon. */
  groundAt(x: number, y: number): { x: number; z: number } | undefined {
    return this.#stage.groundAt(x, y);
  }

  /** The walker nearest to the camera at a point of the picture; `undefined` if there is none. */
  walkerAt(x: number, y: number): number | undefined {
    let best: { walker: number; height: number } | undefined;
    for (const [walker, height] of this.#heights.entries()) {
      if (height === 0 || height < (best?.height ?? 0)) continue;
      const [feet, head] = [this.screenPlace(walker, 0)!, this.screenPlace(walker, HEIGHT)!];
      // Seen from above, the feet are under the head.
      if (distanceToSegment({ x, y }, feet, head) < Math.max(0.2 * height, REACH_PX)) best = { walker, height };
    }
    return best?.walker;
  }

  /** Position in the picture of a walker's axis, `up` metres above the ground; `undefined` if it is not visible. */
  screenPlace(walker: number, up: number): ScreenPlace | undefined {
    if (!this.#heights[walker]) return undefined;
    const { x, z } = this.#hips(walker, point);
    return this.#stage.project(point.set(x, up, z));
  }

  /** Frees all resources; the viewer cannot be used afterwards. */
  dispose(): void {
    for (const part of [this.#bodies, this.#shadows, this.#ground, this.#names, this.#textures]) part.dispose();
    this.#stage.dispose();
  }

  /** Moves the camera's focus towards its target. */
  #moveFocus(wanted: Vector3, dt: number): void {
    this.#focus.lerp(wanted, 1 - 0.5 ** (dt / FOLLOW_HALF_LIFE));
    if (this.#focus.distanceTo(wanted) < ARRIVED) this.#focus.copy(wanted);
  }

  /** Position of a walker's hips, interpolated between the two ticks. */
  #hips(walker: number, out: Vector3): Vector3 {
    const i = CROWD_WALKER_FLOATS * walker;
    if (i >= this.#present.length) return out.set(0, 0, 0);
    return out.fromArray(this.#last, i).lerp(next.fromArray(this.#present, i), this.#textures.uniforms.share.value);
  }

  /** Chooses the body of each walker by its height in the picture. */
  #arrange(): void {
    const { camera, azimuth } = this.#stage.view;
    const { height } = this.#stage.size;
    const pixels = (camera.projectionMatrix.elements[5]! * height) / 2;
    for (let walker = 0; walker < this.#heights.length; walker++) {
      this.#hips(walker, point).applyMatrix4(camera.matrixWorldInverse);
      const depth = -point.z;
      point.applyMatrix4(camera.projectionMatrix);
      const size = (HEIGHT * pixels) / Math.max(depth, camera.near);
      const room = 1 + (2 * size) / height;
      const visible = depth > camera.near && Math.abs(point.x) < room && Math.abs(point.y) < room;
      this.#heights[walker] = visible ? size : 0;
    }
    const fast = this.#stage.quality.shading === "physical";
    const { bodies, outlined } = fast ? LIMITS : this.#stage.still ? STILL : MOVING;
    this.#levels.choose(this.#heights, bodies);
    this.#bodies.arrange(this.#levels);
    this.#shadows.arrange(this.#levels, this.#heights, height, outlined, keyDirection(azimuth, light));
    this.#names.turn(azimuth);
    const { distance } = this.#stage.view;
    this.#fog.near = distance + 0.5 * this.#radius;
    this.#fog.far = distance + 3.2 * this.#radius;
  }

  #applyField(): void {
    if (this.#ground.setField(this.#marks)) void this.#stage.compile();
    this.#ground.radius = this.#radius;
    const names = this.#marks.map(({ name, x, z }) => ({ text: name, x, z }));
    this.#names.set(names, THEMES[this.#theme].ink);
    this.#redraw.request();
  }

  #applyTheme(): void {
    const theme = THEMES[this.#theme];
    this.#stage.setTheme(theme);
    this.#bodies.setTheme(theme);
    this.#shadows.setTheme(theme);
    this.#ground.setTheme(theme);
    this.#fog.color.set(theme.background.outer);
    this.#applyField();
  }
}

/** Distance from a point to a line segment. */
function distanceToSegment(at: ScreenPlace, from: ScreenPlace, to: ScreenPlace): number {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const along = (at.x - from.x) * dx + (at.y - from.y) * dy;
  const share = MathUtils.clamp(along / Math.max(1e-6, dx * dx + dy * dy), 0, 1);
  return Math.hypot(at.x - from.x - share * dx, at.y - from.y - share * dy);
}

const origin = new Vector3();
const middle = new Vector3();
const next = new Vector3();
const point = new Vector3();
const light = new Vector3();
