/** Lesson: follow one update. */
import type { LearnEngine } from "../client/learn/protocol";
import { draggedOf, errorsOf, keyedOf, samplesOf } from "../figures/map/map_measure";
import { MAP_FIELDS, type MapState, TEMPERATURE } from "../figures/map/map_state";
import { meanOf } from "../figures/pairing";
import { DEGREES } from "../humanoid";
import { initialOf } from "../link/hash";
import equation from "./equations/map.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(MAP_FIELDS);

/** Exercise A: factor over the final error that counts as learned. */
const LEARNED = 1.05;
/** Exercise B: largest rotation per frame, and largest error, degrees; and the factor of either that is close. */
const CHANGE = 6;
const ERROR = 2;
const CLOSE = 1.2;
/** Exercise C: maximum number of keys, largest error, degrees, and the tolerance of a near miss. */
const KEYS = 3;
const KEYED = 2;
const KEYED_NEAR = 2.6;
/** The bet: number of updates, and factors of the error that count as diverged, or as slower. */
const UPDATES = 400;
const DIVERGED = 10;
const SLOWER = 1.2;

const passed = (error: unknown, last: unknown) => Number(error) <= LEARNED * Number(last);

export const map: Lesson = lesson<MapState>({
  id: "map",
  fields: MAP_FIELDS,
  figures: [
    { name: "posed", kind: "posed", beats: ["idea", "why"] },
    { name: "som", kind: "som", beats: ["bet", "look", "sources"] },
    { name: "update", kind: "update", beats: ["look"] },
    { name: "learning", kind: "learning", beats: ["look", "exercises"] },
    { name: "pad", kind: "pad", beats: ["idea", "look", "why", "exercises"] },
    { name: "keys", kind: "keys", beats: ["exercises"] },
  ],
  decimals: { temperature: 1, change: 1, right: 1, printed: 0 },
  equation,
  symbols: ["u", "x", "r", "a", "Z", "delta", "sigma", "w", "T", "E"],
  bet: {
    options: ["same", "slower", "diverges"],
    reveal: async (engine) => {
      const [right, printed] = await Promise.all([false, true].map((sign) => engine.somn(UPDATES, sign)));
      const share = printed!.error / right!.error;
      const answer = !(share < DIVERGED) ? "diverges" : share > SLOWER ? "slower" : "same";
      const degrees = { right: right!.error * DEGREES, printed: printed!.error * DEGREES };
      return { answer, measure: { updates: String(UPDATES), ...degrees } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "learning",
      start: { ...PRESET },
      pass: ({ learned, earlier, last }) => passed(learned, last) && !passed(earlier, last),
      near: ({ pass, passes, learned, last }) => {
        if (Number(pass) === 0 || Number(pass) === Number(passes)) return undefined;
        const off = Number(learned) / Number(last) / LEARNED;
        if (off > 1.03) return undefined;
        return off > 1 ? "later" : "earlier";
      },
      refuse: ({ pass, passes }) => pass === passes,
      solve: async (engine) => ({ updates: (await learnedAfter(engine)) * (await framesOf(engine)) }),
    },
    {
      id: "B",
      figure: "pad",
      start: { ...PRESET },
      pass: ({ change, shared }) => Number(change) <= CHANGE && Number(shared) <= ERROR,
      near: ({ change, shared }) => {
        if (Number(shared) <= ERROR && Number(change) <= CLOSE * CHANGE) return "softer";
        if (Number(change) <= CHANGE && Number(shared) <= CLOSE * ERROR) return "harder";
        return undefined;
      },
      refuse: ({ change, shared }) => Number(shared) <= ERROR && Number(change) > CLOSE * CHANGE,
      solve: async (engine) => {
        let { min: temperature } = TEMPERATURE;
        for (; temperature < TEMPERATURE.max; temperature = Number((temperature + 0.1).toFixed(TEMPERATURE.digits)))
          if ((await draggedOf(engine, temperature)).change <= CHANGE) break;
        return { temperature };
      },
    },
    {
      id: "C",
      figure: "keys",
      start: { ...PRESET },
      pass: ({ count, keyed }) => Number(count) <= KEYS && Number(keyed) <= KEYED,
      near: ({ count, keyed }) => {
        if (Number(count) > KEYS) return Number(keyed) <= KEYED ? "fewer" : undefined;
        return Number(keyed) <= KEYED_NEAR ? "turns" : undefined;
      },
      refuse: ({ count, keyed }) => Number(count) < KEYS && Number(keyed) > KEYED_NEAR,
      solve: async (engine) => ({ keys: await threeKeys(engine) }),
    },
  ],
});

async function framesOf(engine: LearnEngine): Promise<number> {
  return (await samplesOf(engine)).values.length / 2;
}

/** The first pass after which the error is nearly the last. */
async function learnedAfter(engine: LearnEngine): Promise<number> {
  const errors = await errorsOf(engine);
  return errors.findIndex((error) => passed(error, errors.at(-1))) + 1;
}

/** Three keys at equal distances, starting where the error is smallest. */
async function threeKeys(engine: LearnEngine): Promise<readonly number[]> {
  const { cycle } = await samplesOf(engine);
  let [best, least] = [PRESET.keys, Number.POSITIVE_INFINITY];
  for (let first = 0; first < cycle.frames / KEYS; first++) {
    const keys = Array.from({ length: KEYS }, (_, i) => Math.round(first + (i * cycle.frames) / KEYS));
    if (keys.at(-1)! >= cycle.frames) continue;
    const error = meanOf((await keyedOf(engine, keys)).errors);
    if (error < least) [best, least] = [keys, error];
  }
  return best;
}
