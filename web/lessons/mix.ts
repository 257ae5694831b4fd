/** Lesson: get weights from distances. */

import type { LearnEngine } from "../client/learn/protocol";
import { firstFrame, measureMix, readingOf, sharesOf, weightAlone } from "../element/figure/mix/mix_measure";
import { DELTA, MIX_FIELDS, type MixState } from "../element/figure/mix/mix_state";
import { initialOf } from "../link/hash";
import equation from "./equations/mix.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(MIX_FIELDS);

/** Exercise A: frames beside the change that pass, and that are close. */
const BESIDE = 2;
const BESIDE_NEAR = 4;
/** So much walking is no change any more. */
const CERTAIN = 0.9;
/** Exercise B: half, and how far from it passes or is close. */
const HALF = 0.5;
const OFF = 0.02;
/** Exercise C: how far from the weight passes, or is close. */
const OFF_ALONE = 0.01;
/** The solution of B is found to this factor. */
const STEP = 1.01;

/** The width at which running is half of what the input is read as. */
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

/** Frame and width of exercise C: what is asked differs from what a mistake gives, and the input is known. */
const ASKED = { at: 160, delta: 2 };

export const mix: Lesson = lesson<MixState>({
  id: "mix",
  fields: MIX_FIELDS,
  figures: [
    {
      name: "reading",
      kind: "reading",
      beats: ["idea", "bet", "look", "why", "exercises", "sources"],
      explained: ["look", "why", "exercises", "sources"],
    },
    {
      name: "bars",
      kind: "bars",
      beats: ["look", "why", "exercises", "sources"],
      explained: ["exercises"],
    },
  ],
  equation,
  symbols: ["lambda", "D", "delta", "min", "t"],
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
      pass: ({ motion, at, change }) => motion === PRESET.motion && Math.abs(Number(at) - Number(change)) <= BESIDE,
      near: ({ motion, at, change }) => {
        if (motion !== PRESET.motion) return "other";
        const off = Number(at) - Number(change);
        if (Math.abs(off) > BESIDE_NEAR) return undefined;
        return off < 0 ? "later" : "earlier";
      },
      refuse: ({ motion, walk }) => motion === PRESET.motion && Number(walk) >= CERTAIN,
      solve: async (engine) => ({
        at: firstFrame(await readingOf(engine, PRESET.motion, PRESET.delta), "walk", "run"),
      }),
    },
    {
      id: "B",
      figure: "reading",
      start: { ...PRESET },
      pass: ({ at, running }) => at === PRESET.at && Math.abs(Number(running) - HALF) <= OFF,
      near: ({ at, motion, running }) => {
        if (at !== PRESET.at || motion !== PRESET.motion) return "other";
        const off = Number(running) - HALF;
        if (Math.abs(off) > 2 * OFF) return undefined;
        return off > 0 ? "more" : "less";
      },
      refuse: ({ at, delta }) => at === PRESET.at && Math.abs(Number(delta) - HALF) <= OFF,
      solve: solveHalf,
    },
    {
      id: "C",
      figure: "bars",
      start: { ...PRESET, ...ASKED },
      pass: ({ guess, alone }) => Number(guess) >= 0 && Math.abs(Number(guess) - Number(alone)) <= OFF_ALONE,
      near: ({ guess, alone }) => {
        if (Number(guess) < 0) return "none";
        const off = Number(guess) - Number(alone);
        if (Math.abs(off) > 2 * OFF_ALONE) return undefined;
        return off < 0 ? "more" : "less";
      },
      refuse: ({ guess, plain }) => Number(guess) >= 0 && Math.abs(Number(guess) - Number(plain)) <= OFF_ALONE,
      solve: async (engine) => {
        const [first, second] = await sharesOf(engine, { ...PRESET, ...ASKED });
        return { guess: weightAlone([first!.square, second!.square], ASKED.delta) };
      },
    },
  ],
});
