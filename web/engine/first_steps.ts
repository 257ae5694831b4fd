/**
 * The walk that is shown until the engine is loaded: the first built-in input without a style, unchanged, in 14 kB. The
 * build makes it (`scripts/first_steps.mjs`).
 */

import { exp, JOINTS, POSE_FLOATS } from "../humanoid";
import { assetOf } from "./assets";
import { inflatedAsset } from "./built_in";

/** Numbers per frame: the root x y z, metres, and a rotation vector per joint, radians. */
const COLUMNS = 3 + 3 * JOINTS;
/** Numbers before the columns: frames, their rate in hertz, and the steps per unit. */
const HEADER = 3;

/** A clip of humanoid poses at a constant rate. */
export class FirstSteps {
  private constructor(
    readonly frames: number,
    readonly rateHz: number,
    readonly poses: Float32Array,
  ) {}

  /** @throws StrutError if it cannot be loaded */
  static async load(): Promise<FirstSteps> {
    const beside = () => new URL("./motions/first_steps.bin", import.meta.url);
    return FirstSteps.of(await inflatedAsset(assetOf("first_steps.bin", beside), "first steps"));
  }

  /** Reads the clip: after the plain header, each column's second differences, all in zigzag LEB128. */
  static of(bytes: Uint8Array): FirstSteps {
    const next = numbersOf(bytes);
    const [frames, rateHz, stepsInUnit] = Array.from({ length: HEADER }, next) as [number, number, number];
    const rows = new Float32Array(frames * COLUMNS);
    for (let column = 0; column < COLUMNS; column++) {
      let [before, last] = [0, 0];
      for (let frame = 0; frame < frames; frame++) {
        [before, last] = [last, next() + 2 * last - before];
        rows[frame * COLUMNS + column] = last / stepsInUnit;
      }
    }
    const poses = new Float32Array(frames * POSE_FLOATS);
    for (let frame = 0; frame < frames; frame++) {
      const row = rows.subarray(frame * COLUMNS, (frame + 1) * COLUMNS);
      const pose = poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
      pose.set(row.subarray(0, 3));
      for (let joint = 0; joint < JOINTS; joint++) {
        const at = 3 + 3 * joint;
        pose.set(exp([row[at]!, row[at + 1]!, row[at + 2]!]), 3 + 4 * joint);
      }
    }
    return new FirstSteps(frames, rateHz, poses);
  }

  /** The pose between two frames. The rotations are close to each other and are interpolated linearly. */
  poseAt(frame: number): Float32Array {
    const i = Math.min(Math.floor(frame), this.frames - 1);
    const j = Math.min(i + 1, this.frames - 1);
    const share = frame - i;
    const pose = this.#pose(i).slice();
    const to = this.#pose(j);
    for (let at = 0; at < 3; at++) pose[at]! += share * (to[at]! - pose[at]!);
    for (let at = 3; at < POSE_FLOATS; at += 4) turnTowards(pose.subarray(at, at + 4), to.subarray(at, at + 4), share);
    return pose;
  }

  #pose(frame: number): Float32Array {
    return this.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
  }
}

function turnTowards(q: Float32Array, to: Float32Array, share: number): void {
  const sign = q.reduce((sum, v, i) => sum + v * to[i]!, 0) < 0 ? -1 : 1;
  for (let i = 0; i < 4; i++) q[i]! += share * (sign * to[i]! - q[i]!);
  const length = Math.hypot(...q);
  for (let i = 0; i < 4; i++) q[i]! /= length;
}

/** Reads whole numbers in zigzag LEB128, one per call. */
function numbersOf(bytes: Uint8Array): () => number {
  let at = 0;
  return () => {
    let zigzag = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[at++]!;
      zigzag |= (byte & 127) << shift;
      if (byte < 128) return (zigzag >>> 1) ^ -(zigzag & 1);
    }
  };
}
