/** Draws the footprints: one instanced outline of a sole. */

import {
  BufferAttribute,
  BufferGeometry,
  CatmullRomCurve3,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  Quaternion,
  ShaderMaterial,
  Vector3,
} from "three";
import { JOINT, type WorldPose } from "../../humanoid";
import type { Theme } from "../themes";
import { FADE_STEPS, FootprintTrail, MAX_PRINTS, type Sole } from "./footprint_trail";

/** Outline of the left sole, (lateral, forward) from below the ankle, metres. */
const OUTLINE: readonly (readonly [x: number, z: number])[] = [
  [0.026, -0.05],
  [0.03, -0.02],
  [0.027, 0.03],
  [0.033, 0.08],
  [0.044, 0.12],
  [0.043, 0.16],
  [0.03, 0.195],
  [0.005, 0.207],
  [-0.02, 0.203],
  [-0.036, 0.185],
  [-0.04, 0.15],
  [-0.037, 0.11],
  [-0.028, 0.06],
  [-0.026, 0.02],
  [-0.03, -0.02],
  [-0.027, -0.05],
  [-0.012, -0.066],
  [0.012, -0.066],
];
/** Opacity of a print that the foot has just left. */
const FRESH = 0.34;
/** Opacity of the planted print, and its size relative to the sole: it is larger, so that it outlines the foot. */
const PLANTED = { opacity: 0.85, width: 1.32, length: 1.03 };
const LEFT_BEHIND = { width: 0.95, length: 0.93 };
/** Half-life of a print's change of colour, seconds. */
const HALF_LIFE = 0.08;

const VERTEX = /* glsl */ `
attribute vec4 tint;
varying vec4 vTint;
void main() {
  vTint = tint;
  gl_Position = projectionMatrix * viewMatrix * modelMatrix * instanceMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = /* glsl */ `
varying vec4 vTint;
void main() {
  gl_FragColor = vTint;
  #include <colorspace_fragment>
}`;

/** The footprints of the character. */
export class Footprints {
  readonly object: InstancedMesh<BufferGeometry, ShaderMaterial>;
  readonly #trail = new FootprintTrail();
  readonly #tints = new InstancedBufferAttribute(new Float32Array(4 * MAX_PRINTS), 4).setUsage(DynamicDrawUsage);
  readonly #shown = new WeakMap<object, { signal: number; opacity: number }>();
  readonly #signal = new Color();
  readonly #mark = new Color();

  constructor() {
    const geometry = soleGeometry();
    geometry.setAttribute("tint", this.#tints);
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
    });
    this.object = new InstancedMesh(geometry, material, MAX_PRINTS);
    this.object.count = 0;
    this.object.frustumCulled = false;
    this.object.renderOrder = -1;
  }

  /** Sets the theme's colours. */
  setTheme({ signal, mark }: Theme): void {
    this.#signal.set(signal);
    this.#mark.set(mark);
  }

  /** Updates the prints with the planted feet of a frame. */
  update(planted: readonly [boolean, boolean], world: WorldPose): void {
    this.#trail.update(planted, [soleOf(world, "left"), soleOf(world, "right")]);
  }

  /** Removes all prints. */
  clear(): void {
    this.#trail.clear();
    this.object.count = 0;
  }

  /** Writes the instances; colours approach their targets over `dtSecs`. */
  draw(dtSecs: number, stature: number): void {
    const share = 1 - 0.5 ** (dtSecs / HALF_LIFE);
    const prints = this.#trail.prints;
    for (const [i, print] of prints.entries()) {
      const target = print.planted
        ? { signal: 1, opacity: PLANTED.opacity }
        : { signal: 0, opacity: FRESH * Math.max(0, 1 - (print.age - 1) / FADE_STEPS) };
      let shown = this.#shown.get(print);
      if (!shown) {
        shown = { signal: 1, opacity: 0 };
        this.#shown.set(print, shown);
      }
      shown.signal += (target.signal - shown.signal) * share;
      shown.opacity += (target.opacity - shown.opacity) * share;
      const width = LEFT_BEHIND.width + (PLANTED.width - LEFT_BEHIND.width) * shown.signal;
      const length = LEFT_BEHIND.length + (PLANTED.length - LEFT_BEHIND.length) * shown.signal;
      position.set(print.x, 0.002, print.z);
      turn.setFromAxisAngle(UP, print.heading);
      scale.set((print.side === 0 ? width : -width) * stature, 1, length * stature);
      this.object.setMatrixAt(i, matrix.compose(position, turn, scale));
      colour.lerpColors(this.#mark, this.#signal, shown.signal);
      this.#tints.setXYZW(i, colour.r, colour.g, colour.b, shown.opacity);
    }
    this.object.count = prints.length;
    this.object.instanceMatrix.needsUpdate = true;
    this.#tints.needsUpdate = true;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.geometry.dispose();
    this.object.material.dispose();
    this.object.dispose();
  }
}

const UP = new Vector3(0, 1, 0);
const position = new Vector3();
const turn = new Quaternion();
const scale = new Vector3();
const matrix = new Matrix4();
const colour = new Color();
const forward = new Vector3();
const up = new Vector3();
const rotation = new Quaternion();

/** The sole of a foot: under the ankle, or under the ankle's position before the heel rose, derived from the toe joint. */
function soleOf(world: WorldPose, side: "left" | "right"): Sole {
  const foot = JOINT[`${side}_foot`];
  rotation.fromArray(world.rotations, 4 * foot);
  forward.set(0, 0, 1).applyQuaternion(rotation);
  up.set(0, 1, 0).applyQuaternion(rotation);
  return {
    x: world.positions[3 * foot]!,
    z: world.positions[3 * foot + 2]!,
    heading: Math.atan2(forward.x, forward.z),
    tilt: Math.acos(Math.min(1, Math.max(-1, up.y))),
  };
}

/** A fan around a point from which the whole outline is visible. */
function soleGeometry(): BufferGeometry {
  const curve = new CatmullRomCurve3(
    OUTLINE.map(([x, z]) => new Vector3(x, 0, z)),
    true,
  );
  const rim = curve.getPoints(72).slice(0, -1);
  const positions = [0, 0, 0.05, ...rim.flatMap(({ x, z }) => [x, 0, z])];
  const indices = rim.flatMap((_, i) => [0, 1 + i, 1 + ((i + 1) % rim.length)]);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setIndex(indices);
  return geometry;
}
