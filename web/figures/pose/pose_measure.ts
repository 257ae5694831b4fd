/** Measures for the exercises about the degrees of freedom of a pose. */
import type { LearnEngine, LearnMotion } from "../../client/learn/protocol";
import {
  DEGREES,
  exp,
  inverse,
  JOINT,
  JOINTS,
  log,
  multiply,
  POSE_FLOATS,
  type Quaternion,
  quaternionAt,
  type Role,
  turned as turnedBy,
  type Vector,
} from "../../humanoid";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { inputOf, type PoseState } from "./pose_state";

/** Numbers per row of degrees of freedom, of which the last is padding. */
const ROW = 68;
/** Number of degrees of freedom of a pose. */
export const DOFS = 3 * JOINTS + 4;
/** Smaller differences are due to rounding: radians, metres and seconds. */
const ROUNDING = 1e-4;

/** A motion rotated as in a state; computed once. */
export const motionOf = memoized((engine, motion: PoseState["motion"], turned: PoseState["turned"], heading: number) =>
  engine.motion(inputOf({ motion, turned, heading })),
);

/** Number of frames of a motion. */
export function framesOf({ poses }: LearnMotion): number {
  return poses.length / POSE_FLOATS;
}

/** R of a joint at a frame. */
export function rotationAt({ poses }: LearnMotion, joint: Role, frame: number): Quaternion {
  return quaternionAt(poses.subarray(frame * POSE_FLOATS + 3, (frame + 1) * POSE_FLOATS), JOINT[joint]);
}

/** R̄ of a joint. */
export function meanOf({ means }: LearnMotion, joint: Role): Quaternion {
  return quaternionAt(means, JOINT[joint]);
}

/** The rotation of a joint's own axes. */
const ownAxes = (phi: number): Quaternion => exp([phi / DEGREES, 0, 0]);

/** w of a joint at a frame in its own axes, radians. */
export function degreesOfFreedom({ rows }: LearnMotion, joint: Role, phi: number, frame: number): Vector {
  const at = ROW * frame + 3 * JOINT[joint];
  // R and R̄ rotate together, so w is only seen in other axes.
  return turnedBy(inverse(ownAxes(phi)), [rows[at]!, rows[at + 1]!, rows[at + 2]!]);
}

/** log R of a joint at a frame in its own axes, radians: computed without a mean. */
export function rawLog(motion: LearnMotion, joint: Role, phi: number, frame: number): Vector {
  return log(multiply(rotationAt(motion, joint, frame), ownAxes(phi)));
}

/** Largest distance of a vector from its value in the previous frame. */
export function greatestJump(frames: number, vectorAt: (frame: number) => Vector): number {
  let [greatest, before] = [0, vectorAt(0)];
  for (let frame = 1; frame < frames; frame++) {
    const now = vectorAt(frame);
    greatest = Math.max(greatest, Math.hypot(...now.map((value, i) => value - before[i]!)));
    before = now;
  }
  return greatest;
}

/** The 67 numbers of a frame. */
export function numbersAt({ rows }: LearnMotion, frame: number): Float32Array {
  return rows.subarray(ROW * frame, ROW * frame + DOFS);
}

/** Whether two numbers are equal up to rounding. */
export function same(a: number, b: number): boolean {
  return Math.abs(a - b) < ROUNDING;
}

/** Number of values in a frame that the state changes. */
export async function changedNumbers(engine: LearnEngine, state: PoseState): Promise<number> {
  const { motion, turned, heading, at } = state;
  const [plain, changed] = await Promise.all([
    motionOf(engine, motion, [], 0),
    motionOf(engine, motion, turned, heading),
  ]);
  const frame = Math.min(at, framesOf(plain) - 1);
  const before = numbersAt(plain, frame);
  return numbersAt(changed, frame).reduce((count, value, i) => count + (same(value, before[i]!) ? 0 : 1), 0);
}

/** The measure of a state; angles in degrees, jumps in radians. */
export async function measurePose(engine: LearnEngine, state: PoseState): Promise<Measure> {
  const { joint, phi, at, heading } = state;
  const motion = await motionOf(engine, state.motion, state.turned, heading);
  const frames = framesOf(motion);
  const frame = Math.min(at, frames - 1);
  const w = degreesOfFreedom(motion, joint, 0, frame);
  const raw = log(rotationAt(motion, joint, frame));
  return {
    motion: state.motion,
    at,
    joint,
    turned: state.turned.length,
    heading: String(heading),
    phi: String(phi),
    angle: Math.hypot(...w) * DEGREES,
    bend: w[0] * DEGREES,
    aside: Math.hypot(w[1], w[2]) * DEGREES,
    straight: Math.hypot(...raw) * DEGREES,
    rawJump: greatestJump(frames, (i) => rawLog(motion, joint, phi, i)),
    jump: greatestJump(frames, (i) => degreesOfFreedom(motion, joint, phi, i)),
    changed: String(await changedNumbers(engine, state)),
  };
}
