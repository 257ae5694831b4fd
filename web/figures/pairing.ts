/** Two performances of one content, paired instant by instant, and their remaining differences. */
import type { LearnEngine, Performed } from "../client/learn/protocol";
import { JOINTS } from "../humanoid";
import { jointDistance, type Measured, meanDistance, measure } from "../player/measured";

/** Which instants are compared: those at the same second, or those with the same content. */
export const PAIRINGS = ["second", "content"] as const;
export type Pairing = (typeof PAIRINGS)[number];

/** An input and its performance in a style. */
export interface Pair {
  rateHz: number;
  proportions: Float32Array;
  input: Measured;
  styled: Measured<Performed>;
  /** Fractional frame of the performance that is paired with each frame of the input; NaN after its end. */
  frames: Record<Pairing, Float64Array>;
  /** Mean distance of the joints in each frame, cm; NaN where nothing is paired. */
  difference: Record<Pairing, Float64Array>;
}

/** Pairs an input with its performance in a style. @throws StrutError */
export async function pairOf(engine: LearnEngine, input: string, style: string): Promise<Pair | undefined> {
  const [motion, performed] = await Promise.all([engine.motion({ name: input }), engine.counterpart(input, style)]);
  if (!performed) return undefined;
  const { rateHz, proportions } = motion;
  const [a, b] = [measure(motion, proportions), measure(performed, proportions)];
  const frames = {
    content: Float64Array.from({ length: a.frames }, (_, f) => f),
    second: Float64Array.from({ length: a.frames }, (_, f) => frameAtTime(performed.timeOut, f / rateHz)),
  };
  const differenceBy = (pairing: Pairing) =>
    frames[pairing].map((other, f) => (Number.isNaN(other) ? Number.NaN : 100 * meanDistance(a, b, f, other)));
  const difference = { content: differenceBy("content"), second: differenceBy("second") };
  return { rateHz, proportions, input: a, styled: b, frames, difference };
}

/** Distance of each joint at a frame, cm; NaN where nothing is paired. */
export function jointDifferences({ input, styled, frames }: Pair, pairing: Pairing, frame: number): number[] {
  const other = frames[pairing][frame]!;
  return Array.from({ length: JOINTS }, (_, joint) =>
    Number.isNaN(other) ? Number.NaN : 100 * jointDistance(input, frame, styled, other, joint),
  );
}

/** Distance of one joint at every frame, cm. */
export function jointCurve({ input, styled, frames }: Pair, pairing: Pairing, joint: number): Float64Array {
  return frames[pairing].map((other, f) =>
    Number.isNaN(other) ? Number.NaN : 100 * jointDistance(input, f, styled, other, joint),
  );
}

/** Mean of the finite values. */
export function meanOf(values: Iterable<number>): number {
  let [sum, count] = [0, 0];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    sum += value;
    count += 1;
  }
  return sum / count;
}

/** Fractional index at which ascending times reach a time; NaN beyond the last one. */
export function frameAtTime(times: ArrayLike<number>, time: number): number {
  let [low, high] = [0, times.length - 1];
  if (high < 0 || time > times[high]!) return Number.NaN;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle;
  }
  const span = times[high]! - times[low]!;
  return span > 0 ? low + Math.max(0, time - times[low]!) / span : low;
}
