/** Lesson: say what K, λ and β do to one prediction. */
import type { LearnEngine } from "../client/learn/protocol";
import { aboveMean, fitOf, LAMBDAS, leastLambda, sweepOf } from "../element/figure/line/line_measure";
import { INSTANTS, LINE_FIELDS, LINE_RANGES, type LineState } from "../element/figure/line/line_state";
import { initialOf } from "../link/hash";
import equation from "./equations/line.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(LINE_FIELDS);
/** Exercise A: few examples and noise, unweighted as in the paper. */
const NOISY: Partial<LineState> = { ...PRESET, k: 12, noise: 4, taper: false };

/** Exercise A: so many times the least error is as good, and so many times is close. */
const AS_GOOD = 1.01;
const CLOSE = 1.02;
/** Exercise B: degrees about the mean, and how many times the least λ passes, or is close. */
const ABOUT = 0.1;
const TIMES = 1.5;
const TIMES_NEAR = 3;
/** Exercise C: degrees from the mean, and how many are close. */
const FAR = 2;
const FAR_NEAR = 1;
/** The solution of C looks at every so many frames. */
const STRIDE = 4;

const isNoisy = ({ k, noise, taper }: Readonly<Record<string, number | string>>) =>
  k === NOISY.k && noise === NOISY.noise && taper === 0;
const isDefault = ({ k, noise, at }: Readonly<Record<string, number | string>>) =>
  k === PRESET.k && noise === 0 && at === PRESET.at;

async function solveFar(engine: LearnEngine): Promise<Partial<LineState>> {
  const state = { ...PRESET, k: LINE_RANGES.k.max, lambda: LINE_RANGES.lambda.min };
  for (let at = 2; at <= INSTANTS.max; at += STRIDE)
    if (Math.abs(aboveMean(await fitOf(engine, { ...state, at }))) >= FAR) return { ...state, at };
  throw new Error("No instant is so far from the mean.");
}

export const line: Lesson = lesson<LineState>({
  id: "line",
  fields: LINE_FIELDS,
  figures: [
    {
      name: "scatter",
      kind: "scatter",
      beats: ["idea", "bet", "look", "why", "exercises", "sources"],
      explained: ["look", "why", "exercises", "sources"],
    },
    { name: "sweep", kind: "sweep", beats: ["sources"], explained: ["sources"] },
  ],
  equation,
  symbols: ["y", "x", "a", "b", "c", "d", "K", "v", "lambda"],
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
      refuse: (measure) => isNoisy(measure) && Number(measure.lambda) < Number(measure.bestLambda),
      solve: async (engine) => {
        const errors = await sweepOf(engine, { ...PRESET, ...NOISY });
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
      refuse: (measure) => isDefault(measure) && Math.abs(Number(measure.above)) <= ABOUT,
      solve: async (engine) => ({ lambda: (await leastLambda(engine, PRESET))! * 1.1 }),
    },
    {
      id: "C",
      figure: "scatter",
      start: { ...PRESET },
      pass: (measure) => Math.abs(Number(measure.above)) >= FAR && measure.noise === 0,
      near: (measure) => {
        if (measure.noise !== 0) return "other";
        return Math.abs(Number(measure.above)) >= FAR_NEAR ? "close" : undefined;
      },
      refuse: (measure) => Number(measure.lambda) >= 1 || Number(measure.k) <= 2,
      solve: solveFar,
    },
  ],
});
