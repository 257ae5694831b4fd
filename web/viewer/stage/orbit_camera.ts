/** The camera: orbit by pointer, touch, wheel and keys, preset views with a glide, and following. */

import { MathUtils, Matrix4, PerspectiveCamera, Vector3 } from "three";

/** The views of the camera. */
export type CameraView = "orbit" | "front" | "side" | "top";

/** Position of the camera relative to its target: radians about +Y from +Z, radians above the ground, metres. */
interface OrbitState {
  azimuth: number;
  elevation: number;
  distance: number;
}

/**
 * Which input zooms: the wheel, regardless of the focus; the wheel only while the picture has the focus or Ctrl or Cmd
 * is held, so that a page can be scrolled with the pointer over the picture; or nothing.
 */
export type Zooming = "always" | "focused" | "never";

/** Vertical field of view, degrees. */
const FIELD_OF_VIEW = 24;
/** Height of the target, metres. */
const TARGET_HEIGHT = 0.83;
/** The first view: from the character's left front. */
export const HOME: OrbitState = { azimuth: MathUtils.degToRad(33), elevation: MathUtils.degToRad(7.2), distance: 5.4 };
const ELEVATIONS = [0.02, MathUtils.degToRad(89)] as const;
/** The range of a camera, by default for one character. */
export interface CameraRange {
  /** The first view; the other views have the same distance. */
  home: OrbitState;
  /** Smallest and largest distance from the target, metres. */
  distances: readonly [number, number];
  /** Far plane of the camera, metres. */
  far: number;
}

const ONE_CHARACTER: CameraRange = { home: HOME, distances: [1.6, 16], far: 60 };

/** Length of a glide between views, seconds. */
const GLIDE = 0.42;
/** Half-life of the distance between the target and the followed point, seconds. */
const FOLLOW_HALF_LIFE = 0.09;
/** Beyond this distance the target jumps, metres. */
const JUMP = 3;
/** Radians per pixel of drag. */
const DRAG_SPEED = 0.0065;
/** Largest change of the camera's matrix that is invisible. */
const STILLNESS = 1e-5;
const KEY_STEP = MathUtils.degToRad(5);

/** cubic-bezier(.2, 0, 0, 1), the project's easing, solved for time by bisection. */
export function ease(time: number): number {
  const bezier = (a: number, b: number, s: number) => 3 * a * s * (1 - s) ** 2 + 3 * b * s * s * (1 - s) + s ** 3;
  let [low, high] = [0, 1];
  for (let i = 0; i < 24; i++) {
    const middle = (low + high) / 2;
    if (bezier(0.2, 0, middle) < time) low = middle;
    else high = middle;
  }
  return bezier(0, 1, (low + high) / 2);
}

/** An orbiting camera over a moving target. */
export class OrbitCamera {
  readonly camera: PerspectiveCamera;
  /** The point on the ground at which the camera looks; smoothed. */
  readonly target = new Vector3();
  /** Called when the user changes the view. */
  onViewChange: ((view: CameraView) => void) | undefined;
  /** Half the width that must fit into the picture, metres. */
  halfWidth = 1.15;
  /** Distance of the top view, metres. */
  above: number;
  /** Height of the subject relative to the mannequin: a taller one is seen from farther away. */
  scale = 1;
  zooming: Zooming = "always";
  readonly #range: CameraRange;
  readonly #state: OrbitState;
  /** The user's own orbit, to which "orbit" returns. */
  #free: OrbitState;
  #glide: { from: OrbitState; to: OrbitState; elapsed: number } | undefined;
  #view: CameraView = "orbit";
  #zoom = 1;
  #settled = false;
  readonly #element: HTMLElement;
  readonly #pointers = new Map<number, { x: number; y: number }>();
  readonly #listeners = new AbortController();

  constructor(element: HTMLElement, range: CameraRange = ONE_CHARACTER) {
    this.#element = element;
    this.#range = range;
    this.#state = { ...range.home };
    this.#free = { ...range.home };
    this.above = 1.15 * range.home.distance;
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.1, range.far);
    const options = { signal: this.#listeners.signal };
    element.addEventListener("pointerdown", (event) => this.#pointerDown(event), options);
    element.addEventListener("pointermove", (event) => this.#pointerMove(event), options);
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"] as const)
      element.addEventListener(type, (event) => this.#pointers.delete(event.pointerId), options);
    element.addEventListener("wheel", (event) => this.#wheel(event), { ...options, passive: false });
    element.addEventListener("keydown", (event) => this.#key(event), options);
  }

  /** The current view. */
  get view(): CameraView {
    return this.#view;
  }

  /** Direction from which the camera looks, radians about +Y from +Z. */
  get azimuth(): number {
    return this.#state.azimuth;
  }

  /** Distance from the target, metres. */
  get distance(): number {
    return this.camera.position.distanceTo(this.target);
  }

  /** Moves to a view of a subject that faces `heading` (radians about +Y). */
  setView(view: CameraView, heading: number, animate: boolean): void {
    this.#view = view;
    const level = MathUtils.degToRad(3);
    const { distance } = this.#range.home;
    const to: OrbitState = {
      orbit: this.#free,
      front: { azimuth: heading, elevation: level, distance },
      side: { azimuth: heading + Math.PI / 2, elevation: level, distance },
      top: { azimuth: heading, elevation: ELEVATIONS[1], distance: this.above },
    }[view];
    this.#zoom = 1;
    const azimuth = this.#state.azimuth + wrap(to.azimuth - this.#state.azimuth);
    if (animate) this.#glide = { from: { ...this.#state }, to: { ...to, azimuth }, elapsed: 0 };
    else {
      this.#glide = undefined;
      Object.assign(this.#state, to);
    }
  }

  /** Makes another orbit the free one, and moves there. */
  orbitAt(orbit: OrbitState, animate: boolean): void {
    this.#free = orbit;
    this.setView("orbit", 0, animate);
  }

  /** Rotates about the target by `by` radians at once, as when a subject with another heading replaces the last one. */
  turn(by: number): void {
    this.#glide = undefined;
    this.#state.azimuth = wrap(this.#state.azimuth + by);
    this.#free = { ...this.#free, azimuth: wrap(this.#free.azimuth + by) };
  }

  /** Moves to the followed point at once, as when the character jumps: at the next update, and until the current glide ends. */
  settle(): void {
    this.#settled = false;
  }

  /** Advances by `dtSecs`, following `point` if `follow` is true. Returns whether the camera has moved. */
  update(dtSecs: number, point: Vector3, follow: boolean): boolean {
    before.copy(this.camera.matrixWorld);
    if (follow || !this.#settled) {
      const far = Math.hypot(point.x - this.target.x, point.z - this.target.z) > JUMP;
      if (far || !this.#settled) this.target.set(point.x, 0, point.z);
      this.#settled = this.#glide === undefined;
      const share = 1 - 0.5 ** (dtSecs / FOLLOW_HALF_LIFE);
      this.target.x += (point.x - this.target.x) * share;
      this.target.z += (point.z - this.target.z) * share;
    }
    if (this.#glide) {
      const glide = this.#glide;
      glide.elapsed += dtSecs;
      const t = ease(Math.min(1, glide.elapsed / GLIDE));
      for (const key of ["azimuth", "elevation", "distance"] as const)
        this.#state[key] = glide.from[key] + (glide.to[key] - glide.from[key]) * t;
      if (glide.elapsed >= GLIDE) this.#glide = undefined;
    }
    this.#place();
    const now = this.camera.matrixWorld.elements;
    return before.elements.some((value, i) => Math.abs(value - now[i]!) > STILLNESS);
  }

  /** Looks at another position from the same side, `x` and `z` metres from the current one. */
  shift(x: number, z: number): void {
    this.target.x += x;
    this.target.z += z;
    this.#place();
  }

  /** Sets the size of the picture, of which `covered` pixels at the right are hidden; the target is centred in the rest. */
  resize(width: number, height: number, covered = 0): void {
    this.camera.aspect = width / Math.max(1, height);
    if (covered > 0) this.camera.setViewOffset(width, height, covered / 2, 0, width, height);
    else this.camera.clearViewOffset();
    this.camera.updateProjectionMatrix();
  }

  dispose(): void {
    this.#listeners.abort();
  }

  #place(): void {
    const { azimuth, elevation } = this.#state;
    // A narrow picture is seen from farther away, not with a wider field of view.
    const half = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2));
    const fit = Math.max(1, this.halfWidth / (half * this.camera.aspect) / this.#range.home.distance);
    const distance = this.#state.distance * fit * this.#zoom * this.scale;
    const height = TARGET_HEIGHT * this.scale;
    const ground = distance * Math.cos(elevation);
    const { camera, target } = this;
    camera.position.set(
      target.x + ground * Math.sin(azimuth),
      height + distance * Math.sin(elevation),
      target.z + ground * Math.cos(azimuth),
    );
    // When looking straight down, "up" is the view's horizontal direction.
    camera.up.set(0, 1, 0);
    if (elevation > 1.5) camera.up.set(-Math.sin(azimuth), 0, -Math.cos(azimuth));
    camera.lookAt(target.x, height, target.z);
    camera.updateMatrixWorld();
  }

  #orbit(azimuth: number, elevation: number): void {
    this.#glide = undefined;
    this.#state.azimuth = wrap(this.#state.azimuth + azimuth);
    this.#state.elevation = MathUtils.clamp(this.#state.elevation + elevation, ...ELEVATIONS);
    this.#takeOver();
  }

  #zoomBy(factor: number): void {
    if (this.zooming === "never") return;
    this.#glide = undefined;
    this.#state.distance = MathUtils.clamp(this.#state.distance * factor, ...this.#range.distances);
    this.#takeOver();
  }

  #takeOver(): void {
    this.#free = { ...this.#state };
    if (this.#view === "orbit") return;
    this.#view = "orbit";
    this.onViewChange?.("orbit");
  }

  #pointerDown(event: PointerEvent): void {
    if (event.pointerType === "mouse" && event.button !== 0) return;
    this.#element.setPointerCapture(event.pointerId);
    this.#pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  #pointerMove(event: PointerEvent): void {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const now = { x: event.clientX, y: event.clientY };
    if (this.#pointers.size === 1) this.#orbit((before.x - now.x) * DRAG_SPEED, (now.y - before.y) * DRAG_SPEED);
    else {
      const other = [...this.#pointers].find(([id]) => id !== event.pointerId)![1];
      const spread = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y) || 1;
      this.#zoomBy(spread(before) / spread(now));
    }
    this.#pointers.set(event.pointerId, now);
  }

  #wheel(event: WheelEvent): void {
    // Browsers report a pinch on a touchpad as Ctrl and wheel.
    const isMeant = event.ctrlKey || event.metaKey || this.#element.matches(":focus");
    if (this.zooming === "never" || (this.zooming === "focused" && !isMeant)) return;
    event.preventDefault();
    this.#zoomBy(Math.exp(MathUtils.clamp(event.deltaY, -120, 120) * 0.0015));
  }

  #key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action: Record<string, () => void> = {
      ArrowLeft: () => this.#orbit(-KEY_STEP, 0),
      ArrowRight: () => this.#orbit(KEY_STEP, 0),
      ArrowUp: () => this.#orbit(0, KEY_STEP),
      ArrowDown: () => this.#orbit(0, -KEY_STEP),
      "+": () => this.#zoomBy(0.9),
      "=": () => this.#zoomBy(0.9),
      "-": () => this.#zoomBy(1 / 0.9),
    };
    const act = action[event.key];
    if (!act) return;
    act();
    event.preventDefault();
    event.stopPropagation();
  }
}

const before = new Matrix4();

function wrap(angle: number): number {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}
