/** The 3-D view of a crowd: up to a thousand walkers on a ground that is a map of styles. */

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
export interface NamedMark extends FieldMark {
  name: string;
}

/** A place of the picture, CSS pixels from its top left. */
export interface ScreenPlace {
  x: number;
  y: number;
}

const RANGE: CameraRange = {
  home: { azimuth: MathUtils.degToRad(16), elevation: MathUtils.degToRad(17), distance: 19 },
  distances: [3, 90],
  far: 220,
};
/** Half the width that has to fit into the picture at home, metres. */
const HALF_WIDTH = 4.6;
/** Distance from which the view from above shows most of the ground, in radii of it, and the greatest, metres. */
const ABOVE = 3.4;
const HIGHEST = 80;
/** Time in which the camera covers half the way to whom it follows, or back, seconds. */
const FOLLOW_HALF_LIFE = 0.16;
/** Nearer than this it is there, metres. */
const ARRIVED = 1e-3;
/** Height of somebody, metres. */
const HEIGHT = 1.7;
/** Radius of the ring around somebody who is chosen, metres. */
const RING = 0.55;
/** Who is nearer to the pointer than this is meant by it, however small he is, CSS pixels. */
const REACH_PX = 13;
/** Who wears the finer bodies, and the least height, a share of the picture's, of who has an outline for a shadow. */
interface Limits {
  bodies: BodyLimits;
  outlined: number;
}
const LIMITS: Limits = { bodies: BODY_LIMITS, outlined: 0.05 };
/** The same without a graphics card, of what stands still and of what moves. */
const STILL: Limits = { bodies: { near: { height: 220, count: 0 }, middle: { height: 90, count: 8 } }, outlined: 0.14 };
const MOVING: Limits = {
  bodies: { near: { height: 220, count: 0 }, middle: { height: 150, count: 3 } },
  outlined: 0.2,
};

/** The bones that everybody is drawn on, by those of the motion: joints have to lie on them. 21 × xyz, metres. */
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
  /** Joints of the last tick and of the present one. */
  #last = new Float32Array(0);
  #present = new Float32Array(0);
  #radius = 10;
  #lastTime: number | undefined;
  /** Who is chosen. */
  #chosen: number | undefined;
  /** What the camera looks at: the middle, somebody, or on the way between them. */
  readonly #focus = new Vector3();
  /** Whether the camera follows who is chosen. */
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

  /** What a screen reader says of the picture. */
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

  /** Called when the user's hand turns a preset view into a free one. */
  set onViewChange(callback: ((view: CameraView) => void) | undefined) {
    this.#stage.view.onViewChange = callback;
  }

  /** Triangles and draw calls of the last frame. */
  get cost(): { triangles: number; calls: number } {
    return this.#stage.cost;
  }

  /** What draws, by the name that the browser gives it. */
  get drawnBy(): string {
    return this.#stage.drawnBy;
  }

  /** Where the camera looks from, radians about +Y from +Z. */
  get azimuth(): number {
    return this.#stage.view.azimuth;
  }

  /** Whether nothing is left to draw. */
  get still(): boolean {
    return this.#stage.still && !this.#redraw.pending;
  }

  /** Who is chosen: there is a ring around him. */
  set chosen(walker: number | undefined) {
    this.#chosen = walker;
    this.#redraw.request();
  }

  /** Takes the bone offsets of everybody: 21 × xyz, metres. */
  setProportions(proportions: ArrayLike<number>): void {
    const fit = fitTo(proportions);
    const { seen, outline } = prismBodies(fit);
    this.#bodies.setBody(fit, seen);
    this.#shadows.setBody(outline);
    this.#redraw.request();
  }

  /** Takes the field, and the radius in which people walk, metres. */
  setField(marks: readonly NamedMark[], radius: number): void {
    this.#marks = marks;
    this.#radius = radius;
    this.#stage.view.above = Math.min(HIGHEST, ABOVE * radius);
    this.#applyField();
  }

  /**
   * Takes a tick: `CROWD_WALKER_FLOATS` numbers a walker, and four bytes of tint (sRGB, and its share). `isOther` says that these
   * walkers are not those of the last tick.
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

  /** Goes to a view, gliding. */
  camera(view: CameraView): void {
    this.#stage.setView(view, 0);
    this.#redraw.request();
  }

  /**
   * Draws a frame `share` of the way from the last tick to the present one, unless those before are still being drawn;
   * `timeSecs` is any clock, and `fine` asks for the finer picture of what stands still. Says whether it was drawn.
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

  /** A copy of the picture; only right after {@link render} has drawn it, in the same task. */
  copy(): HTMLCanvasElement {
    return this.#stage.copy();
  }

  /** Asks for the picture to be drawn again, though nothing of it has changed. */
  invalidate(): void {
    this.#redraw.request();
  }

  /** Where a place of the world is in the picture, CSS pixels from its top left; `undefined` behind the camera. */
  screenPosition(x: number, y: number, z: number): ScreenPlace | undefined {
    const { camera } = this.#stage.view;
    const isBehind = point.set(x, y, z).applyMatrix4(camera.matrixWorldInverse).z > -camera.near;
    return isBehind ? undefined : this.#stage.project(point.set(x, y, z));
  }

  /** The place on the ground under a place of the picture, metres; `undefined` at the sky. */
  groundAt(x: number, y: number): { x: number; z: number } | undefined {
    return this.#stage.groundAt(x, y);
  }

  /** Whoever is nearest to the camera of those at a place of the picture; `undefined` where nobody is. */
  walkerAt(x: number, y: number): number | undefined {
    let best: { walker: number; height: number } | undefined;
    for (const [walker, height] of this.#heights.entries()) {
      if (height === 0 || height < (best?.height ?? 0)) continue;
      const [feet, head] = [this.screenPlace(walker, 0)!, this.screenPlace(walker, HEIGHT)!];
      // From above the feet are under the head.
      if (distanceToSegment({ x, y }, feet, head) < Math.max(0.2 * height, REACH_PX)) best = { walker, height };
    }
    return best?.walker;
  }

  /** Where the middle of somebody is in the picture, so many metres above the ground; `undefined` out of sight. */
  screenPlace(walker: number, up: number): ScreenPlace | undefined {
    if (!this.#heights[walker]) return undefined;
    const { x, z } = this.#hips(walker, point);
    return this.#stage.project(point.set(x, up, z));
  }

  /** Frees everything; the viewer cannot be used afterwards. */
  dispose(): void {
    for (const part of [this.#bodies, this.#shadows, this.#ground, this.#names, this.#textures]) part.dispose();
    this.#stage.dispose();
  }

  /** Goes on towards what the camera is to look at. */
  #moveFocus(wanted: Vector3, dt: number): void {
    this.#focus.lerp(wanted, 1 - 0.5 ** (dt / FOLLOW_HALF_LIFE));
    if (this.#focus.distanceTo(wanted) < ARRIVED) this.#focus.copy(wanted);
  }

  /** Where the hips of somebody are between the two ticks. */
  #hips(walker: number, out: Vector3): Vector3 {
    const i = CROWD_WALKER_FLOATS * walker;
    if (i >= this.#present.length) return out.set(0, 0, 0);
    return out.fromArray(this.#last, i).lerp(next.fromArray(this.#present, i), this.#textures.uniforms.share.value);
  }

  /** Chooses everybody's body by his height in the picture. */
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

/** Distance from a place to the nearest of those between two others. */
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
