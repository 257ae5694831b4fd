/** Lesson: trade content for style knowingly. */

import { biasOf, leastReach, survives } from "../figures/bias/bias_measure";
import { BIAS_FIELDS, BIAS_RANGES, type BiasState } from "../figures/bias/bias_state";
import type { Measure } from "../figures/kind";
import { initialOf } from "../link/hash";
import equation from "./equations/bias.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(BIAS_FIELDS);

/** Exercise A: half of the raise, the tolerances of a pass and of a near miss, and the share that many learners would set. */
const HALF = 0.5;
const OFF = 0.02;
const NAIVE = 0.5;
/** Exercise B: a raise slightly outside the band, and the factors over the minimum width that pass and that are close. */
const SLIGHT = 10;
const WIDER = 0.3;
/** Exercise C: tolerance of the answer, degrees. */
const DEGREES_OFF = 0.5;
/** A share below this is little, and above that much. */
const LITTLE = 0.25;
const MUCH = 0.75;

export const bias: Lesson = lesson<BiasState>({
  id: "bias",
  fields: BIAS_FIELDS,
  figures: [
    { name: "raised", kind: "raised" },
    { name: "band", kind: "band", beats: ["look", "why", "exercises", "sources"] },
  ],
  equation,
  decimals: { reach: 1, guess: 1, returned: 1, bias: 1 },
  symbols: ["x", "mu", "sigma", "kappa", "dx", "beta", "rho", "y"],
  bet: {
    options: ["little", "half", "all"],
    reveal: async (engine) => {
      const [without, usual] = await Promise.all([0, PRESET.keep].map((keep) => survives(engine, { ...PRESET, keep })));
      const share = without!;
      const answer = share < LITTLE ? "little" : share > MUCH ? "all" : "half";
      return { answer, measure: { share, usual: usual!, keep: PRESET.keep } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "band",
      start: { ...PRESET, keep: 0 },
      pass: (measure) => isPreset(measure) && Math.abs(Number(measure.share) - HALF) <= OFF,
      near: (measure) => {
        if (!isPreset(measure)) return "other";
        const off = Number(measure.share) - HALF;
        if (Math.abs(off) > 2 * OFF) return undefined;
        return off < 0 ? "more" : "less";
      },
      refuse: (measure) => isPreset(measure) && Math.abs(Number(measure.keep) - NAIVE) <= OFF,
      solve: async (engine) => {
        // Between these the share is nearly linear in ρ; each evaluation takes the engine a second.
        const [low, high] = [0.8, 1];
        const [less, more] = [
          await survives(engine, { ...PRESET, keep: low }),
          await survives(engine, { ...PRESET, keep: high }),
        ];
        return { keep: low + ((HALF - less) / (more - less)) * (high - low) };
      },
    },
    {
      id: "B",
      figure: "band",
      start: { ...PRESET, raise: SLIGHT },
      pass: (measure) => {
        const spare = Number(measure.reach) - Number(measure.leastReach);
        return isSlight(measure) && measure.bias === 0 && spare <= WIDER;
      },
      near: (measure) => {
        if (!isSlight(measure)) return "other";
        const spare = Number(measure.reach) - Number(measure.leastReach);
        if (Math.abs(spare) > 2 * WIDER) return undefined;
        return spare < 0 ? "more" : "less";
      },
      refuse: (measure) => isSlight(measure) && Number(measure.reach) - Number(measure.leastReach) > 2 * WIDER,
      solve: async (engine) => {
        const { digits } = BIAS_RANGES.reach;
        const least = leastReach(await biasOf(engine, { ...PRESET, raise: SLIGHT }));
        return { reach: Math.ceil(least * 10 ** digits + 0.5) / 10 ** digits };
      },
    },
    {
      id: "C",
      figure: "band",
      start: { ...PRESET },
      pass: (measure) => isAsked(measure) && isTyped(measure, Number(measure.returned)),
      near: (measure) => {
        if (!isAsked(measure)) return "other";
        if (Number.isNaN(measure.guess)) return "none";
        const off = Number(measure.guess) - Number(measure.returned);
        if (Math.abs(off) <= 2 * DEGREES_OFF) return off < 0 ? "more" : "less";
        return isTyped(measure, PRESET.keep * (Number(measure.x) - Number(measure.mean))) ? "edge" : undefined;
      },
      refuse: (measure) => isAsked(measure) && isTyped(measure, PRESET.keep * Number(measure.x)),
      solve: async (engine) => ({ guess: (await biasOf(engine, PRESET)).returned }),
    },
  ],
});

/** Whether only ρ differs from the start of exercise A. */
function isPreset({ motion, style, raise, reach }: Measure): boolean {
  return motion === PRESET.motion && style === PRESET.style && raise === PRESET.raise && reach === PRESET.reach;
}

/** Whether only κ and ρ differ from the start of exercise B. */
function isSlight({ motion, style, raise, at }: Measure): boolean {
  return motion === PRESET.motion && style === PRESET.style && raise === SLIGHT && at === PRESET.at;
}

/** Whether the state is that of exercise C. */
function isAsked(measure: Measure): boolean {
  return isPreset(measure) && measure.at === PRESET.at && measure.keep === PRESET.keep;
}

/** Whether the learner typed this number of degrees. */
function isTyped({ guess }: Measure, degrees: number): boolean {
  return Math.abs(Number(guess) - degrees) <= DEGREES_OFF;
}
