/** Measures for the exercises about the line of one degree of freedom; angles in degrees. */

import type { Fit, LearnEngine } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { DEGREES } from "../../humanoid";
import type { Measure } from "../kind";
import { type LineState, lookOf, settingsOf } from "./line_state";

/** The values of λ in a sweep. */
export const LAMBDAS: readonly number[] = Array.from({ length: 25 }, (_, i) => 10 ** (-4 + (5 * i) / 24));

/** "About the mean" means within this distance, degrees. */
const ABOUT_MEAN = 0.1;
/** The smallest λ is found up to this factor. */
const LEAST_STEP = 1.02;

/** If the coefficients of all three terms are below this, only the mean is left. */
const NO_SLOPE = 0.05;

/** The terms of Eq. 2 that sum to a prediction, degrees. */
export interface Terms {
  /** a xₜ₋₁, b yₜ₋₁, c xₜ and d: they sum to the prediction, except for the returned part. */
  a: number;
  b: number;
  c: number;
  d: number;
  /** ρΔx of Eq. 7: 0 within the neighbours' band. */
  returned: number;
}

/** The contribution of each term of the line to its prediction; Δx is subtracted before (Eq. 7). */
export function termsOf({ beta, query, means, bias }: Fit): Terms {
  const [a, b, c] = beta;
  const [xPrevious, yPrevious, x] = query;
  const returned = DEFAULT_OPTIONS.rho * bias;
  const terms = [a * (xPrevious - bias), b * (yPrevious - returned), c * (x - bias)] as const;
  const d = means.y - a * means.xPrevious - b * means.yPrevious - c * means.x;
  return {
    a: terms[0] * DEGREES,
    b: terms[1] * DEGREES,
    c: terms[2] * DEGREES,
    d: d * DEGREES,
    returned: returned * DEGREES,
  };
}

/** The fit of a state. */
export function fitOf(engine: LearnEngine, state: LineState): Promise<Fit> {
  return engine.fit(lookOf(state), settingsOf(state));
}

/** Errors of free-running predictions with a state's other settings, degrees, by λ. */
export async function sweepOf(
  engine: LearnEngine,
  state: LineState,
  lambdas: readonly number[] = LAMBDAS,
): Promise<number[]> {
  const { lambda: _, ...settings } = settingsOf(state);
  const errors = await engine.sweep(lookOf(state), settings, lambdas);
  return Array.from(errors, (error) => error * DEGREES);
}

/** ŷ − ȳ: difference between the prediction and the neighbours' mean, degrees. */
export function aboveMean({ predicted, means }: Fit): number {
  return (predicted - means.y) * DEGREES;
}

/** σ of the residuals about the line of all three terms, degrees. */
export function residual({ x, xPrevious, y, yPrevious, weights, beta, means }: Fit): number {
  let [sum, total] = [0, 0];
  weights.forEach((weight, i) => {
    const [a, b, c] = beta;
    const line =
      means.y + a * (xPrevious[i]! - means.xPrevious) + b * (yPrevious[i]! - means.yPrevious) + c * (x[i]! - means.x);
    sum += weight * (y[i]! - line) ** 2;
    total += weight;
  });
  return total > 0 ? Math.sqrt(sum / total) * DEGREES : 0;
}

/** The smallest λ from which on the prediction is about the mean; `undefined` if the largest is not enough. */
export async function leastLambda(engine: LearnEngine, state: LineState): Promise<number | undefined> {
  const isAbout = async (lambda: number) =>
    Math.abs(aboveMean(await fitOf(engine, { ...state, lambda }))) <= ABOUT_MEAN;
  let [low, high] = [0.0001, 10];
  if (!(await isAbout(high))) return undefined;
  // The prediction may cross the mean when its sign changes; λ counts from where it stays near.
  while (high / low > LEAST_STEP) {
    const middle = Math.sqrt(low * high);
    if (await isAbout(middle)) high = middle;
    else low = middle;
  }
  return high;
}

/** The measure of a state. */
export async function measureLine(engine: LearnEngine, state: LineState): Promise<Measure> {
  const [fit, errors, own, least] = await Promise.all([
    fitOf(engine, state),
    sweepOf(engine, state),
    sweepOf(engine, state, [state.lambda]),
    leastLambda(engine, state),
  ]);
  const leastError = Math.min(...errors);
  return {
    motion: state.motion,
    style: state.style,
    at: state.at,
    joint: state.joint,
    axis: state.axis,
    k: state.k,
    lambda: state.lambda,
    noise: state.noise,
    taper: state.taper ? 1 : 0,
    x: fit.query[2] * DEGREES,
    predicted: fit.predicted * DEGREES,
    mean: fit.means.y * DEGREES,
    above: aboveMean(fit),
    slope: fit.beta[2],
    // What determines the prediction.
    left: fit.beta.every((one) => Math.abs(one) < NO_SLOPE) ? "mean" : "line",
    error: own[0]!,
    leastError,
    bestLambda: LAMBDAS[errors.indexOf(leastError)]!,
    leastLambda: least ?? Number.NaN,
  };
}
