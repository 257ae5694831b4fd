/** Lesson: compute weights from distances. */

import type { LearnEngine } from "../client/learn/protocol";
import type { Measure } from "../figures/kind";
import { firstFrame, measureMix, readingOf, sharesOf, weightAlone } from "../figures/mix/mix_measure";
import { DELTA, MIX_FIELDS, type MixState } from "../figures/mix/mix_state";
import { initialOf } from "../link/hash";
import equation from "./equations/mix.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(MIX_FIELDS);

/** Exercise A: distances from the change that pass, and that are close, frames. */
const BESIDE = 2;
const BESIDE_NEAR = 4;
/** From this weight of walking on, the change is over. */
const CERTAIN = 0.9;
/** Exercise B: half, and the tolerances of a pass and of a near miss. */
const HALF = 0.5;
const OFF = 0.02;
/** Exercise C: tolerances of a pass and of a near miss. */
const OFF_ALONE = 0.01;
/** The solution of B is found up to this factor. */
const STEP = 1.01;

/** The width at which running has half of the weight. */
async function solveHalf(engine: LearnEngine): Promise<Partial<MixState>> {
  let [low, high]: [number, number] = [DELTA.min, DELTA.max];
  while (high / low > STEP) {
    const delta = Math.sqrt(low * high);
    const { running } = await measureMix(engine, { ...PRESET, delta });
    if (Number(running) > HALF) low = delta;
    else high = delta;
  }
  return { delta: Math.sqrt(low * high) };
}

/** Frame and width of exercise C: the answer differs from those of mistakes, and the input is known. */
const ASKED = { at: 460, delta: 2 };

/** Whether a measure has the input of all exercises. */
const isInput = ({ motion }: Measure) => motion === PRESET.motion;
/** Whether only the instant differs from the start of exercise A, only δ from that of B, and only the guess from that of C. */
const isRead = (measure: Measure) => isInput(measure) && measure.delta === PRESET.delta;
const isFrame = (measure: Measure) => isInput(measure) && measure.at === PRESET.at;
const isAsked = (measure: Measure) => isInput(measure) && measure.at === ASKED.at && measure.delta === ASKED.delta;

const isTyped = ({ guess }: Measure) => Number(guess) >= 0;
/** Whether the guess of exercise C is a given weight: the right one, or that of a mistake. */
const isAt = (measure: Measure, what: "alone" | "plain") =>
  Math.abs(Number(measure.guess) - Number(measure[what])) <= OFF_ALONE;

export const mix: Lesson = lesson<MixState>({
  id: "mix",
  fields: MIX_FIELDS,
  figures: [
    { name: "reading", kind: "reading" },
    { name: "bars", kind: "bars", beats: ["look", "why", "exercises", "sources"], explained: ["exercises"] },
  ],
  equation,
  symbols: ["lambda", "D", "delta", "min", "t"],
  decimals: { guess: 3, alone: 3 },
  bet: {
    options: ["gains", "loses", "same"],
    reveal: async (engine) => {
      const [once, twice] = await Promise.all(
        [PRESET.delta, 2 * PRESET.delta].map((delta) => measureMix(engine, { ...PRESET, delta })),
      );
      const [before, after] = [Number(once!.running), Number(twice!.running)];
      const answer = after > before ? "gains" : after < before ? "loses" : "same";
      return { answer, measure: { before, after } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "reading",
      start: { ...PRESET },
      pass: (measure) => isRead(measure) && Math.abs(Number(measure.at) - Number(measure.change)) <= BESIDE,
      near: (measure) => {
        if (!isRead(measure)) return "other";
        const { at, change } = measure;
        const off = Number(at) - Number(change);
        if (Math.abs(off) > BESIDE_NEAR) return undefined;
        return off < 0 ? "later" : "earlier";
      },
      refuse: (measure) => isRead(measure) && Number(measure.walk) >= CERTAIN,
      solve: async (engine) => ({
        at: firstFrame(await readingOf(engine, PRESET.motion, PRESET.delta), "walk", "run"),
      }),
    },
    {
      id: "B",
      figure: "reading",
      start: { ...PRESET },
      pass: (measure) => isFrame(measure) && Math.abs(Number(measure.running) - HALF) <= OFF,
      near: (measure) => {
        if (!isFrame(measure)) return "other";
        const off = Number(measure.running) - HALF;
        if (Math.abs(off) > 2 * OFF) return undefined;
        return off > 0 ? "more" : "less";
      },
      refuse: (measure) => isFrame(measure) && Math.abs(Number(measure.delta) - HALF) <= OFF,
      solve: solveHalf,
    },
    {
      id: "C",
      figure: "bars",
      start: { ...PRESET, ...ASKED },
      pass: (measure) => isAsked(measure) && isTyped(measure) && isAt(measure, "alone"),
      near: (measure) => {
        if (!isAsked(measure)) return "other";
        if (!isTyped(measure)) return "none";
        const off = Number(measure.guess) - Number(measure.alone);
        if (Math.abs(off) > 2 * OFF_ALONE) return undefined;
        return off < 0 ? "more" : "less";
      },
      refuse: (measure) => isAsked(measure) && isTyped(measure) && isAt(measure, "plain"),
      solve: async (engine) => {
        const [first, second] = await sharesOf(engine, { ...PRESET, ...ASKED });
        return { guess: weightAlone([first!.square, second!.square], ASKED.delta) };
      },
    },
  ],
});
