/** Measures for the exercises about the evaluation of methods. */
import type { LearnEngine } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { DEGREES, JOINT, JOINTS } from "../../humanoid";
import { type Measured, measure } from "../../player/measured";
import type { Style } from "../built_in";
import type { Measure } from "../kind";
import { AXES } from "../line/line_state";
import { memoized } from "../memoized";
import { meanOf } from "../pairing";
import { inputOf, type JudgeState, METHODS, type Method, type Take } from "./judge_state";
import { type Achieved, BUILT_IN_OTHER_TAKE, RECORDED, type Standing, steadiest } from "./recorded";

/** Joints that are compared: all but the hips, which are at the origin once the root is removed. */
export const COMPARED = JOINTS - 1;
/** Length of the moving average that is subtracted to get the fast content, seconds. */
const SLOW_SECS = 0.5;
/** Frames between two examined corrections; the first frames have no past. */
const STRIDE = 8;
const FIRST = 4;

/** The result of a method on a take. */
export interface Trial extends Achieved {
  pose: number;
  /** Mean distance of the joints from the performance in each frame, mm. */
  errors: Float64Array;
}

/** A take and its performance in a style, with the joints of every frame. */
interface Held {
  rateHz: number;
  proportions: Float32Array;
  input: Measured;
  truth: Measured;
}

const heldOf = memoized(async (engine, take: Take, style: Style): Promise<Held> => {
  const [motion, performed] = await Promise.all([engine.motion({ name: take }), engine.counterpart(take, style)]);
  if (!performed) throw new Error(`“${take}” has no recording in the style “${style}”.`);
  const { rateHz, proportions } = motion;
  return { rateHz, proportions, input: measure(motion, proportions), truth: measure(performed, proportions) };
});

/** The result of a method on a take that is held out, or left in; computed once. */
export const trialOf = memoized(
  async (engine, take: Take, style: Style, leftIn: boolean, method: Method): Promise<Trial> => {
    // Without foot planting, as in the evaluation.
    const options = { ...DEFAULT_OPTIONS, styles: { [style]: 1 }, method, footplant: false };
    const [held, styled] = await Promise.all([
      heldOf(engine, take, style),
      engine.stylize(inputOf({ take, leftIn }), options),
    ]);
    const predicted = measure(styled, held.proportions);
    const errors = poseErrors(predicted, held.truth);
    return {
      errors,
      pose: meanOf(errors),
      acceleration: accelerationOf(predicted) / accelerationOf(held.input),
      content: contentOf(held.input, predicted, Math.floor(SLOW_SECS * held.rateHz) | 1),
    };
  },
);

/** The results of the methods on a take, and their floors; `onMethod` is called before the first method and after each one. */
export async function standingOn(
  engine: LearnEngine,
  { take, style, leftIn }: JudgeState,
  onMethod: (sofar: Standing) => void = () => {},
): Promise<Standing> {
  const { input, truth } = await heldOf(engine, take, style);
  const methods = new Map<Method, Trial>();
  const floor = BUILT_IN_OTHER_TAKE === undefined ? {} : { otherTake: BUILT_IN_OTHER_TAKE };
  const standing = { methods, unchanged: meanOf(poseErrors(input, truth)), ...floor };
  onMethod(standing);
  await Promise.all(
    METHODS.map(async (method) => {
      methods.set(method, await trialOf(engine, take, style, leftIn, method));
      onMethod(standing);
    }),
  );
  return standing;
}

/** Mean distance in each frame of joints relative to the hips, heading removed, mm. */
function poseErrors(a: Measured, b: Measured): Float64Array {
  return Float64Array.from({ length: Math.min(a.frames, b.frames) }, (_, frame) => {
    const hips = 3 * JOINTS * frame;
    const rise = a.local[hips + 1]! - b.local[hips + 1]!;
    let sum = 0;
    for (let at = hips + 3; at < hips + 3 * JOINTS; at += 3) {
      const apart = (axis: number) => a.local[at + axis]! - b.local[at + axis]!;
      sum += Math.hypot(apart(0), apart(1) - rise, apart(2));
    }
    return (1000 * sum) / COMPARED;
  });
}

/** Mean magnitude of the second difference of the joints, metres per squared frame. */
function accelerationOf({ local, frames }: Measured): number {
  const size = 3 * JOINTS;
  let sum = 0;
  for (let at = size; at < size * (frames - 1); at += 3) {
    const second = (axis: number) => local[at + axis - size]! - 2 * local[at + axis]! + local[at + axis + size]!;
    sum += Math.hypot(second(0), second(1), second(2));
  }
  return sum / (JOINTS * (frames - 2));
}

/** Correlation of the fast content of two motions, after subtracting a moving average of `window` frames. */
function contentOf(a: Measured, b: Measured, window: number): number {
  const frames = Math.min(a.frames, b.frames);
  let [ab, aa, bb] = [0, 0, 0];
  for (let number = 3; number < 3 * JOINTS; number++) {
    const [x, y] = [fast(a, number, frames, window), fast(b, number, frames, window)];
    x.forEach((value, frame) => {
      ab += value * y[frame]!;
      aa += value * value;
      bb += y[frame]! * y[frame]!;
    });
  }
  return aa * bb > 0 ? ab / Math.sqrt(aa * bb) : 0;
}

/** One coordinate of a joint relative to the hips over time, minus its centred moving average, which is shorter at the ends. */
function fast({ local }: Measured, number: number, frames: number, window: number): Float64Array {
  const value = (frame: number) => local[3 * JOINTS * frame + number]! - local[3 * JOINTS * frame + (number % 3)]!;
  const sums = new Float64Array(frames + 1);
  for (let frame = 0; frame < frames; frame++) sums[frame + 1] = sums[frame]! + value(frame);
  const reach = window >> 1;
  return Float64Array.from({ length: frames }, (_, frame) => {
    const [from, to] = [Math.max(0, frame - reach), Math.min(frames, frame + reach + 1)];
    return value(frame) - (sums[to]! - sums[from]!) / (to - from);
  });
}

/** Frames at which corrections are examined. */
export function framesOfCorrections(frames: number): number[] {
  return Array.from({ length: Math.floor((frames - 1 - FIRST) / STRIDE) + 1 }, (_, i) => FIRST + i * STRIDE);
}

/** β⊤(u − ū): difference between the line's answer and the neighbours' mean at a frame, degrees. */
export async function correctionAt(engine: LearnEngine, state: JudgeState, frame: number): Promise<number> {
  const { k, lambda, rho, coherence } = DEFAULT_OPTIONS;
  const dof = 3 * JOINT[state.joint] + AXES.indexOf(state.axis);
  const look = { input: inputOf(state), styles: { [state.style]: 1 }, frame };
  const { predicted, means, bias } = await engine.fit(look, { dof, k, lambda, noise: 0, taper: coherence });
  // The bias is added after the line's answer.
  return (predicted - means.y - rho * bias) * DEGREES;
}

/** Names of the methods in sentences. */
const nameOf = (method: Method) => method.toUpperCase();

/** The measure of a state. */
export async function measureJudge(engine: LearnEngine, state: JudgeState): Promise<Measure> {
  const { take, style, at, leftIn, source } = state;
  const trial = (method: Method, left = leftIn) => trialOf(engine, take, style, left, method);
  const [{ rateHz }, pick, rival, out, left] = await Promise.all([
    heldOf(engine, take, style),
    trial(state.pick),
    trial(state.rival),
    trial("nn", false),
    trial("nn", true),
  ]);
  const advantage = (pin: number) => (rival.errors[pin] ?? Number.NaN) - (pick.errors[pin] ?? Number.NaN);
  const shown = source === "live" ? pick : RECORDED[source].methods.get(state.pick);
  return {
    take,
    style,
    at,
    secs: at / rateHz,
    leftIn: leftIn ? 1 : 0,
    honest: state.honest,
    source,
    pick: nameOf(state.pick),
    rival: nameOf(state.rival),
    pickError: pick.pose,
    rivalError: rival.pose,
    pickPin: state.pickPin,
    rivalPin: state.rivalPin,
    pickGain: advantage(state.pickPin),
    rivalGain: -advantage(state.rivalPin),
    out: out.pose,
    in: left.pose,
    acceleration: shown?.acceleration ?? Number.NaN,
    content: shown?.content ?? Number.NaN,
    steadiest: nameOf(steadiest(RECORDED.off) ?? "nn"),
  };
}
