/** Lesson: compute the pace of a blend. */
import type { Measure } from "../figures/kind";
import { longestOf, pacedOf, ratioOf } from "../figures/pace/pace_measure";
import { PACE_FIELDS, type PaceState, WEIGHT } from "../figures/pace/pace_state";
import { initialOf } from "../link/hash";
import equation from "./equations/time.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(PACE_FIELDS);

/** Ratios to the input's length in exercises A and B, and the tolerance of a pass. */
const LONGER = 1.2;
const EQUAL = 1;
const OFF = 0.005;
/** Exercise A: the weight of a learner who confuses it with the delay. */
const NAIVE = { weight: 0.2, off: 0.02 };
/** Exercise B: minimum weight of both styles. */
const LEAST = 0.25;
/** Exercise C: step between the weights that its solution tries. */
const STEP = 0.05;
/** The bet: shares of the delay that count as less than half, or as more. */
const HALF = 0.5;
const HALF_OFF = 0.05;

const isPreset = ({ motion }: Measure) => motion === PRESET.motion;
const isInside = ({ old, childlike, neutral }: Measure) =>
  [old, childlike, neutral].every((weight) => Number(weight) >= -1e-9 && Number(weight) <= 1);

export const time: Lesson = lesson<PaceState>({
  id: "time",
  fields: PACE_FIELDS,
  figures: [
    {
      name: "paced",
      kind: "paced",
      beats: ["idea", "bet", "why", "sources"],
      explained: ["idea", "bet", "why", "sources"],
    },
    { name: "polygon", kind: "polygon", beats: ["look", "exercises"] },
    { name: "clock", kind: "clock", beats: ["look", "exercises"] },
    { name: "votes", kind: "votes", beats: ["look", "why", "sources"] },
  ],
  equation,
  symbols: ["w", "g", "h", "s"],
  bet: {
    options: ["less", "half", "more"],
    reveal: async (engine) => {
      const [half, all] = (await Promise.all(
        [HALF, 1].map(async (old) => ratioOf(await pacedOf(engine, { ...PRESET, old, childlike: 0 })) - 1),
      )) as [number, number];
      const share = half / all;
      const answer = share < HALF - HALF_OFF ? "less" : share > HALF + HALF_OFF ? "more" : "half";
      return { answer, measure: { half: 100 * half, all: 100 * all, share } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "polygon",
      start: { ...PRESET },
      pass: (measure) => isPreset(measure) && measure.childlike === 0 && isWithin(measure, LONGER, OFF),
      near: (measure) => {
        if (!isPreset(measure) || measure.childlike !== 0) return "other";
        if (!isWithin(measure, LONGER, 2 * OFF)) return undefined;
        return Number(measure.ratio) < LONGER ? "more" : "less";
      },
      refuse: (measure) =>
        isPreset(measure) && measure.childlike === 0 && Math.abs(Number(measure.old) - NAIVE.weight) <= NAIVE.off,
      solve: async (engine) => {
        let [low, high] = [0, 1];
        while (high - low > 0.5 * 10 ** -WEIGHT.digits) {
          const old = (low + high) / 2;
          if (ratioOf(await pacedOf(engine, { ...PRESET, old })) < LONGER) low = old;
          else high = old;
        }
        return { old: (low + high) / 2 };
      },
    },
    {
      id: "B",
      figure: "polygon",
      start: { ...PRESET, old: 0.5, childlike: 0.5 },
      pass: (measure) => isPreset(measure) && isMixed(measure) && isWithin(measure, EQUAL, OFF),
      near: (measure) => {
        if (!isPreset(measure)) return "motion";
        if (!isMixed(measure)) return "other";
        if (!isWithin(measure, EQUAL, 2 * OFF)) return undefined;
        return Number(measure.ratio) > EQUAL ? "slow" : "fast";
      },
      refuse: (measure) => isPreset(measure) && isMixed(measure) && measure.old === measure.childlike,
      solve: async (engine) => {
        const old = LEAST + 0.01;
        let [low, high] = [LEAST, 1 - old];
        while (high - low > 0.5 * 10 ** -WEIGHT.digits) {
          const childlike = (low + high) / 2;
          if (ratioOf(await pacedOf(engine, { ...PRESET, old, childlike })) > EQUAL) low = childlike;
          else high = childlike;
        }
        return { old, childlike: (low + high) / 2 };
      },
    },
    {
      id: "C",
      figure: "polygon",
      start: { ...PRESET },
      pass: (measure) => isPreset(measure) && Number(measure.ratio) > Number(measure.longest),
      near: (measure) => {
        if (!isPreset(measure)) return "other";
        return isInside(measure) || Number(measure.ratio) < 1 ? undefined : "further";
      },
      refuse: (measure) => isPreset(measure) && isInside(measure),
      solve: async (engine) => {
        const { ratio } = await longestOf(engine, PRESET.motion);
        let old = 1;
        while (old < WEIGHT.max && ratioOf(await pacedOf(engine, { ...PRESET, old })) <= ratio) old += STEP;
        return { old };
      },
    },
  ],
});

/** Whether the output's length has a given ratio to the input's. */
function isWithin({ ratio }: Measure, wanted: number, off: number): boolean {
  return Math.abs(Number(ratio) - wanted) <= off;
}

/** Whether both styles have the weights of exercise B. */
function isMixed(measure: Measure): boolean {
  return isInside(measure) && Number(measure.old) >= LEAST && Number(measure.childlike) >= LEAST;
}
