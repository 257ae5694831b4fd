/** Lesson: explain the effects of K, λ and β on one prediction. */
import type { LearnEngine } from "../client/learn/protocol";
import type { Measure } from "../figures/kind";
import { aboveMean, fitOf, LAMBDAS, leastLambda, sweepOf } from "../figures/line/line_measure";
import { INSTANTS, LINE_FIELDS, LINE_RANGES, type LineState } from "../figures/line/line_state";
import { initialOf } from "../link/hash";
import equation from "./equations/line.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(LINE_FIELDS);
/** Exercise A: few examples and noise, unweighted as in the paper; in this style both mistakes are costly. */
const NOISY: LineState = { ...PRESET, style: "angry", k: 12, noise: 4, taper: false };

/** Exercise A: factors over the smallest error that pass, and that are close. */
const AS_GOOD = 1.01;
const CLOSE = 1.02;
/** Exercise B: distance that counts as about the mean, degrees, and factors over the smallest λ that pass, or are close. */
const ABOUT = 0.1;
const TIMES = 1.5;
const TIMES_NEAR = 3;
/** Exercise C: distances from the mean that pass and that are close, degrees. */
const FAR = 2;
const FAR_NEAR = 1;
/** Frames between those that the solution of C examines. */
const STRIDE = 4;

/** Whether a measure has the joint of all exercises, in a style. */
const isOfTheKnee = ({ motion, style, joint, axis }: Measure, wanted: LineState["style"]) =>
  motion === PRESET.motion && style === wanted && joint === PRESET.joint && axis === PRESET.axis;
/** The error is that of the whole walk, at any instant. */
const isNoisy = (measure: Measure) =>
  isOfTheKnee(measure, NOISY.style) && measure.k === NOISY.k && measure.noise === NOISY.noise && measure.taper === 0;
const isTapered = (measure: Measure) =>
  isOfTheKnee(measure, PRESET.style) && measure.noise === 0 && measure.taper === 1;
const isDefault = (measure: Measure) => isTapered(measure) && measure.k === PRESET.k && measure.at === PRESET.at;
/** λ leaves nothing of the line, or there is a single dot: the prediction is about the mean. */
const isFlat = ({ lambda, k }: Measure) => Number(lambda) >= 1 || Number(k) <= 2;

async function solveFar(engine: LearnEngine): Promise<Partial<LineState>> {
  const state = { ...PRESET, k: LINE_RANGES.k.max, lambda: LINE_RANGES.lambda.min };
  for (let at = 2; at <= INSTANTS.max; at += STRIDE)
    if (Math.abs(aboveMean(await fitOf(engine, { ...state, at }))) >= FAR) return { ...state, at };
  throw new Error("No frame is this far from the mean.");
}

export const line: Lesson = lesson<LineState>({
  id: "line",
  fields: LINE_FIELDS,
  figures: [
    { name: "scatter", kind: "scatter" },
    { name: "terms", kind: "terms", beats: ["look", "why"] },
    // It reveals the answer to exercise A.
    { name: "sweep", kind: "sweep", beats: ["exercises", "sources"], after: "A" },
  ],
  equation,
  symbols: ["y", "x", "a", "b", "c", "d", "K", "v", "lambda"],
  decimals: { k: 0, lambda: 4, leastLambda: 4, bestLambda: 4, noise: 1, at: 0 },
  bet: {
    options: ["zero", "one", "any"],
    reveal: async (engine) => {
      const { beta } = await fitOf(engine, { ...PRESET, k: 1 });
      const slope = beta[2];
      return { answer: slope === 0 ? "zero" : Math.abs(slope - 1) < 0.1 ? "one" : "any", measure: { slope } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "scatter",
      start: { ...NOISY, lambda: 0.001 },
      pass: (measure) => isNoisy(measure) && Number(measure.error) <= AS_GOOD * Number(measure.leastError),
      near: (measure) => {
        if (!isNoisy(measure)) return "other";
        if (Number(measure.error) > CLOSE * Number(measure.leastError)) return undefined;
        return Number(measure.lambda) < Number(measure.bestLambda) ? "more" : "less";
      },
      refuse: (measure) =>
        isNoisy(measure) &&
        Number(measure.lambda) < Number(measure.bestLambda) &&
        Number(measure.error) > CLOSE * Number(measure.leastError),
      solve: async (engine) => {
        const errors = await sweepOf(engine, NOISY);
        return { lambda: LAMBDAS[errors.indexOf(Math.min(...errors))]! };
      },
    },
    {
      id: "B",
      figure: "scatter",
      start: { ...PRESET, lambda: 0.01 },
      pass: (measure) =>
        isDefault(measure) &&
        Math.abs(Number(measure.above)) <= ABOUT &&
        Number(measure.lambda) <= TIMES * Number(measure.leastLambda),
      near: (measure) => {
        if (!isDefault(measure)) return "other";
        if (Math.abs(Number(measure.above)) > ABOUT) {
          return Math.abs(Number(measure.above)) <= 2 * ABOUT ? "more" : undefined;
        }
        return Number(measure.lambda) <= TIMES_NEAR * Number(measure.leastLambda) ? "less" : undefined;
      },
      refuse: (measure) =>
        isDefault(measure) &&
        Math.abs(Number(measure.above)) <= ABOUT &&
        Number(measure.lambda) > TIMES_NEAR * Number(measure.leastLambda),
      solve: async (engine) => ({ lambda: (await leastLambda(engine, PRESET))! * 1.1 }),
    },
    {
      id: "C",
      figure: "scatter",
      start: { ...PRESET },
      pass: (measure) => isTapered(measure) && Math.abs(Number(measure.above)) >= FAR,
      near: (measure) => {
        if (!isTapered(measure)) return "other";
        return Math.abs(Number(measure.above)) >= FAR_NEAR ? "close" : undefined;
      },
      refuse: (measure) => isTapered(measure) && isFlat(measure),
      solve: solveFar,
    },
  ],
});
