/** Measures for the exercises about a synthesised step. */

import type { JointPath, LearnEngine } from "../../client/learn/protocol";
import { DEGREES } from "../../humanoid";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { CHAIN_FIELDS, type ChainState, dofOf, stylesOf } from "./chain_state";

/** Number of states of a step. */
export const STATES = 5;
/** Frames per second of the walk model; `chain.test.ts` checks it against the engine. */
export const WALK_HZ = 30;

const askPath = memoized((engine, state: ChainState): Promise<JointPath> => {
  const { pose, velocity, acceleration, left, right } = state;
  return engine.walkPath(stylesOf(state), dofOf(state), {
    variance: [pose, velocity, acceleration],
    rho: [left, right],
  });
});

/** The trajectory of a state; computed once. */
export function pathOf(engine: LearnEngine, state: ChainState): Promise<JointPath> {
  return askPath(engine, state);
}

/** The trajectory of a state with the model's own variances. */
export function plainOf(engine: LearnEngine, state: ChainState): Promise<JointPath> {
  const { pose, velocity, acceleration } = CHAIN_FIELDS;
  return askPath(engine, {
    ...state,
    pose: pose.initial,
    velocity: velocity.initial,
    acceleration: acceleration.initial,
  });
}

/** Largest distance of the curve from its state's mean, degrees. */
export function farthest({ c, mean }: JointPath): number {
  return c.reduce((most, value, i) => Math.max(most, Math.abs(value - mean[i]!)), 0) * DEGREES;
}

/** Largest distance in deviations of the model, without the factor of the variance. */
export function farthestDeviations({ c, mean, deviation }: JointPath, factor: number): number {
  const of = (value: number, i: number) => (Math.abs(value - mean[i]!) * Math.sqrt(factor)) / deviation[i]!;
  return c.reduce((most, value, i) => Math.max(most, of(value, i)), 0);
}

/** Mean magnitude of the third difference, degrees: the jerk of the curve. */
export function jerkOf({ c }: JointPath): number {
  let sum = 0;
  for (let i = 3; i < c.length; i++) sum += Math.abs(c[i]! - 3 * c[i - 1]! + 3 * c[i - 2]! - c[i - 3]!);
  return (sum / (c.length - 3)) * DEGREES;
}

/** Frames of a left step and of a right one. */
export function framesOf({ durations }: JointPath): readonly [left: number, right: number] {
  const sum = (from: number) => durations.slice(from, from + STATES).reduce((a, b) => a + b, 0);
  return [sum(0), sum(STATES)];
}

/** Steps per minute. */
export function cadenceOf(path: JointPath): number {
  const [left, right] = framesOf(path);
  return (2 * 60 * WALK_HZ) / (left + right);
}

/** The measure of a state; angles in degrees. */
export async function measureChain(engine: LearnEngine, state: ChainState): Promise<Measure> {
  const [path, plain] = await Promise.all([pathOf(engine, state), plainOf(engine, state)]);
  const { style, share, joint, axis, pose, velocity, acceleration, left, right } = state;
  return {
    style,
    share,
    joint,
    axis,
    pose,
    velocity,
    acceleration,
    left,
    right,
    farthest: farthest(path),
    deviations: farthestDeviations(path, pose),
    jerk: jerkOf(path),
    jerkShare: jerkOf(path) / jerkOf(plain),
    cadence: cadenceOf(path),
  };
}
