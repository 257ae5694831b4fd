/** Paths of hands, feet and head: a line for each around the current frame, fading with time. */

import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Group, Line, ShaderMaterial } from "three";
import { createWorldPose, JOINT, POSE_FLOATS, worldFromLocal } from "../../humanoid";
import type { Theme } from "../themes";

/** Joints that have a line. */
const TRACED = [JOINT.head, JOINT.left_hand, JOINT.right_hand, JOINT.left_foot, JOINT.right_foot];
/** Frames before and after the current one: three quarters of a second at 60 Hz. */
const AROUND = 45;
const POINTS = 2 * AROUND + 1;
/** Opacity behind the current frame and ahead of it. */
const OPACITY = { behind: 0.85, ahead: 0.4 };

const VERTEX = /* glsl */ `
attribute float strength;
varying float vStrength;
void main() {
  vStrength = strength;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = /* glsl */ `
uniform vec3 colour;
varying float vStrength;
void main() {
  gl_FragColor = vec4(colour, vStrength);
  #include <colorspace_fragment>
}`;

/** Transform from a clip to its character: a rotation about +Y, then a translation over the ground. */
export interface Placement {
  turn: number;
  x: number;
  z: number;
}

export class MotionTrail {
  readonly object = new Group();
  readonly #colour = { value: new Color() };
  readonly #lines: { positions: BufferAttribute; strengths: BufferAttribute; line: Line }[];
  #clip: Float32Array | null = null;
  #proportions: ArrayLike<number> = [];
  /** Positions of the traced joints in the clip, frames × joints × xyz; computed when they are first drawn. */
  #places = new Float32Array(0);
  #known = new Uint8Array(0);
  readonly #world = createWorldPose();

  constructor() {
    this.object.visible = false;
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { colour: this.#colour },
      transparent: true,
      depthWrite: false,
    });
    this.#lines = TRACED.map(() => {
      const geometry = new BufferGeometry();
      const positions = new BufferAttribute(new Float32Array(3 * POINTS), 3).setUsage(DynamicDrawUsage);
      const strengths = new BufferAttribute(new Float32Array(POINTS), 1).setUsage(DynamicDrawUsage);
      geometry.setAttribute("position", positions);
      geometry.setAttribute("strength", strengths);
      const line = new Line(geometry, material);
      line.frustumCulled = false;
      line.renderOrder = 4;
      this.object.add(line);
      return { positions, strengths, line };
    });
  }

  setTheme({ signal }: Theme): void {
    this.#colour.value.set(signal);
  }

  /** Sets the poses of a clip and the bones on which they are defined; `null` draws nothing. */
  setClip(clip: Float32Array | null, proportions: ArrayLike<number>): void {
    this.#clip = clip;
    this.#proportions = proportions;
    const frames = clip ? clip.length / POSE_FLOATS : 0;
    this.#places = new Float32Array(3 * TRACED.length * frames);
    this.#known = new Uint8Array(frames);
  }

  /** Draws the lines around a frame of the clip. */
  draw(frame: number, { turn, x, z }: Placement): void {
    const frames = this.#known.length;
    const first = Math.max(0, Math.round(frame) - AROUND);
    const last = Math.min(frames - 1, Math.round(frame) + AROUND);
    const count = frames > 0 ? Math.max(0, last - first + 1) : 0;
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    for (let i = 0; i < count; i++) this.#compute(first + i);
    for (const [j, { positions, strengths, line }] of this.#lines.entries()) {
      for (let i = 0; i < count; i++) {
        const p = 3 * (TRACED.length * (first + i) + j);
        const [px, pz] = [this.#places[p]!, this.#places[p + 2]!];
        positions.setXYZ(i, c * px + s * pz + x, this.#places[p + 1]!, c * pz - s * px + z);
        const from = first + i - frame;
        const near = Math.max(0, 1 - Math.abs(from) / AROUND);
        strengths.setX(i, near * (from > 0 ? OPACITY.ahead : OPACITY.behind));
      }
      positions.needsUpdate = true;
      strengths.needsUpdate = true;
      line.geometry.setDrawRange(0, count);
    }
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const { line } of this.#lines) line.geometry.dispose();
    (this.#lines[0]!.line.material as ShaderMaterial).dispose();
  }

  #compute(frame: number): void {
    if (this.#known[frame] === 1 || !this.#clip) return;
    this.#known[frame] = 1;
    const pose = this.#clip.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
    worldFromLocal(this.#proportions, pose, this.#world);
    for (const [j, joint] of TRACED.entries())
      for (let axis = 0; axis < 3; axis++)
        this.#places[3 * (TRACED.length * frame + j) + axis] = this.#world.positions[3 * joint + axis]!;
  }
}
