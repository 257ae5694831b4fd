/** Measures for the exercises about the bias; angles in degrees. */
import type { Fit, LearnEngine } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { createWorldPose, DEGREES, JOINT, POSE_FLOATS, worldFromLocal } from "../../humanoid";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { type BiasState, lookOf, NO_GUESS, raisedInput, SETTINGS } from "./bias_state";

/** The band of a degree of freedom at a frame, degrees. */
export interface Band {
  /** xₜ, and x of every neighbour. */
  x: number;
  examples: readonly number[];
  /** μ and σ of the neighbours, with the floors of the bias. */
  mean: number;
  deviation: number;
  /** Δx. */
  bias: number;
  /** ρΔx: the returned part. */
  returned: number;
  /** ũᵀβ: the line's prediction for the rest, and yₜ. */
  line: number;
  y: number;
}

/** The band of a fit. */
function bandOf(fit: Fit, keep: number): Band {
  const [x, mean, deviation, bias, y] = [fit.query[2], fit.means.x, fit.deviation, fit.bias, fit.predicted].map(
    (radians) => radians * DEGREES,
  ) as [number, number, number, number, number];
  const returned = keep * bias;
  return {
    x,
    examples: Array.from(fit.x, (radians) => radians * DEGREES),
    mean,
    deviation,
    bias,
    returned,
    line: y - returned,
    y,
  };
}

/** The band of a state. */
export async function biasOf(engine: LearnEngine, state: BiasState): Promise<Band> {
  return bandOf(await engine.fit(lookOf(state), SETTINGS), state.keep);
}

/** The smallest κ at which nothing is outside the band. */
export function leastReach({ x, mean, deviation }: Pick<Band, "x" | "mean" | "deviation">): number {
  return Math.abs(x - mean) / deviation;
}

/** Mean angle of both upper arms from straight down over a motion, degrees. */
export function elevation(poses: Float32Array, proportions: ArrayLike<number>): number {
  const world = createWorldPose();
  const frames = poses.length / POSE_FLOATS;
  let sum = 0;
  for (let frame = 0; frame < frames; frame++) {
    worldFromLocal(proportions, poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS), world);
    for (const side of ["left", "right"] as const) {
      const [from, to] = [3 * JOINT[`${side}_upper_arm`], 3 * JOINT[`${side}_lower_arm`]];
      const [x, y, z] = [0, 1, 2].map((axis) => world.positions[to + axis]! - world.positions[from + axis]!) as [
        number,
        number,
        number,
      ];
      sum += Math.acos(-y / Math.hypot(x, y, z)) * DEGREES;
    }
  }
  return sum / (2 * frames);
}

/** Mean elevations of the input and of the output. */
const elevationsOf = memoized(
  async (engine, motion: BiasState["motion"], style: string, raise: number, kappa: number, rho: number) => {
    const input = raisedInput({ motion, raise });
    const [given, { poses }] = await Promise.all([
      engine.motion(input),
      engine.stylize(input, { ...DEFAULT_OPTIONS, styles: { [style]: 1 }, kappa, rho }),
    ]);
    return { input: elevation(given.poses, given.proportions), styled: elevation(poses, given.proportions) };
  },
);

/** Share of the arms' raise that is left in the output. */
export async function survives(engine: LearnEngine, state: BiasState): Promise<number> {
  const { motion, style, raise, reach, keep } = state;
  if (raise === 0) return Number.NaN;
  const [raised, plain] = await Promise.all(
    [raise, 0].map((angle) => elevationsOf(engine, motion, style, angle, reach, keep)),
  );
  return (raised!.styled - plain!.styled) / (raised!.input - plain!.input);
}

/** The measure of a state. */
export async function measureBias(engine: LearnEngine, state: BiasState): Promise<Measure> {
  const [band, share] = await Promise.all([biasOf(engine, state), survives(engine, state)]);
  return {
    motion: state.motion,
    style: state.style,
    at: state.at,
    raise: state.raise,
    reach: state.reach,
    keep: state.keep,
    guess: state.guess === NO_GUESS ? Number.NaN : state.guess,
    x: band.x,
    mean: band.mean,
    deviation: band.deviation,
    bias: band.bias,
    returned: band.returned,
    y: band.y,
    leastReach: leastReach(band),
    share,
  };
}
