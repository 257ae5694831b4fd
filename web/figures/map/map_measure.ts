/** Measures for the exercises about key-styling. */
import type { LearnEngine } from "../../client/learn/protocol";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { meanOf } from "../pairing";
import { type MapState, sharingOf } from "./map_state";

/** The training data; requested once. */
export const samplesOf = memoized((engine) => engine.styleSamples());
/** The error after every pass, degrees; requested once. */
export const errorsOf = memoized((engine) => engine.somnErrors());
/** How smoothly the model can be dragged. */
export const draggedOf = memoized((engine, temperature: number) => engine.dragged(sharingOf({ temperature })));
/** The cycle from its keys. */
export const keyedOf = memoized((engine, keys: readonly number[]) => engine.keyed(keys));

/** Number of passes finished by some updates: 0 before the end of the first. */
export function passOf(updates: number, frames: number): number {
  return Math.floor(updates / frames);
}

/** The gap between two keys with the largest error: the frames of both, and the error. */
export function worstStretch(
  errors: Float32Array,
  keys: readonly number[],
): { from: number; to: number; error: number } {
  let worst = { from: keys[0] ?? 0, to: keys[0] ?? 0, error: 0 };
  errors.forEach((error, frame) => {
    if (error <= worst.error) return;
    // The cycle continues from its last key to its first.
    const from = [...keys].reverse().find((key) => key <= frame) ?? keys.at(-1)!;
    const to = keys.find((key) => key > frame) ?? keys[0]!;
    worst = { from, to, error };
  });
  return worst;
}

/** The measure of a state; angles in degrees, whole numbers as text. */
export async function measureMap(engine: LearnEngine, state: MapState): Promise<Measure> {
  const [samples, errors, dragged, keyed] = await Promise.all([
    samplesOf(engine),
    errorsOf(engine),
    draggedOf(engine, state.temperature),
    keyedOf(engine, state.keys),
  ]);
  const frames = samples.values.length / 2;
  const pass = passOf(state.updates, frames);
  const worst = worstStretch(keyed.errors, state.keys);
  const ms = (frame: number) => String(Math.round((1000 * frame) / samples.rateHz));
  return {
    printed: state.printed ? 1 : 0,
    updates: String(state.updates),
    pass: String(pass),
    passes: String(errors.length),
    learned: pass > 0 ? (errors[pass - 1] ?? Number.NaN) : Number.NaN,
    earlier: pass > 1 ? (errors[pass - 2] ?? Number.NaN) : Number.POSITIVE_INFINITY,
    last: errors.at(-1)!,
    temperature: state.temperature,
    change: dragged.change,
    shared: dragged.error,
    count: String(state.keys.length),
    keyed: meanOf(keyed.errors),
    from: ms(worst.from),
    to: ms(worst.to),
    worst: worst.error,
  };
}
