/** Lesson: find what the distance ignores. */
import type { LearnEngine } from "../client/learn/protocol";
import type { Measure } from "../figures/kind";
import { backwards, distanceOf, foundOf } from "../figures/near/near_measure";
import { NEAR_FIELDS, type NearState, NO_GUESS, WINDOWS } from "../figures/near/near_state";
import { initialOf } from "../link/hash";
import equation from "./equations/near.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(NEAR_FIELDS);

/** Exercise A: largest ratio of a neighbour's distance to the nearest one's, and the share of it at which K is close. */
const TIMES = 2;
const CLOSE = 0.1;
/** Exercise B: minimum rotation of a query, degrees, and minimum translation, metres; tolerance, mm. */
const TURNED = 45;
const MOVED = 0.5;
const MM_OFF = 0.1;
/** Exercise C: required ratio of the nearest distance with reversed time to that without. */
const BACKWARDS = 4;

/** The bet: rotation and translation of the query, and changes of √D₁ in mm that count as none, or as a little. */
const MOVE = { heading: 90, x: 1 };
const SAME = 0.1;
const LITTLE = 100;

/** Whether the query is the lesson's own, except for its position. */
const isPlain = ({ motion, at, turned }: Measure) => motion === PRESET.motion && at === PRESET.at && turned === 0;
/** Whether it is also forward in time and has the engine's own window. */
const isForward = (measure: Measure) => isPlain(measure) && measure.reversed === 0 && measure.window === PRESET.window;
/** The smallest window that distinguishes a query from its reverse. */
const leastWindow = (measure: Measure) => WINDOWS.find((window) => Number(measure[`backwards${window}`]) >= BACKWARDS);
const isMoved = ({ heading, moved }: Measure) => Number(heading) >= TURNED && Number(moved) >= MOVED;

export const near: Lesson = lesson<NearState>({
  id: "near",
  fields: NEAR_FIELDS,
  figures: [
    { name: "query", kind: "query" },
    { name: "profile", kind: "profile", beats: ["look", "why", "exercises", "sources"] },
  ],
  equation,
  // As displayed in the figures.
  decimals: { first: 1, last: 1 },
  symbols: ["D", "w", "theta", "x0", "z0", "y", "z", "s", "K"],
  bet: {
    options: ["same", "little", "much"],
    reveal: async (engine) => {
      const [before, after] = (await Promise.all(
        [PRESET, { ...PRESET, ...MOVE }].map(async (state) => 1000 * distanceOf(await foundOf(engine, state), 0)),
      )) as [number, number];
      const change = Math.abs(after - before);
      const answer = change < SAME ? "same" : change < LITTLE ? "little" : "much";
      return { answer, measure: { before, after } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "profile",
      start: { ...PRESET },
      pass: (measure) => isForward(measure) && Number(measure.lastRatio) <= TIMES && Number(measure.nextRatio) > TIMES,
      near: (measure) => {
        if (!isForward(measure)) return "other";
        const ratio = Number(measure.lastRatio);
        if (Math.abs(ratio - TIMES) > CLOSE * TIMES) return undefined;
        return ratio <= TIMES ? "more" : "less";
      },
      refuse: (measure) =>
        isForward(measure) && Number(measure.lastRatio) ** 2 <= TIMES && Number(measure.nextRatio) ** 2 > TIMES,
      solve: async (engine) => {
        const found = await foundOf(engine, PRESET);
        let k = 1;
        while (distanceOf(found, k) <= TIMES * distanceOf(found, 0)) k++;
        return { k };
      },
    },
    {
      id: "B",
      figure: "profile",
      start: { ...PRESET, guess: NO_GUESS },
      pass: (measure) =>
        isForward(measure) && isMoved(measure) && Math.abs(Number(measure.guess) - Number(measure.change)) < MM_OFF,
      near: (measure) => {
        if (!isForward(measure)) return "other";
        if (!isMoved(measure)) return "further";
        return Number.isNaN(measure.guess) ? "none" : undefined;
      },
      refuse: (measure) => isForward(measure) && isMoved(measure) && Number(measure.guess) >= MM_OFF,
      solve: async () => ({ ...MOVE, guess: 0 }),
    },
    {
      id: "C",
      figure: "profile",
      start: { ...PRESET, window: "1" },
      pass: (measure) => isPlain(measure) && measure.reversed === 1 && measure.window === leastWindow(measure),
      near: (measure) => {
        if (!isPlain(measure)) return "other";
        if (measure.reversed === 0) return "forward";
        return Number(measure.window) > Number(leastWindow(measure)) ? "shorter" : undefined;
      },
      refuse: (measure) => isPlain(measure) && measure.reversed === 1 && measure.window === "1",
      solve: async (engine) => ({ reversed: true, window: await leastTelling(engine) }),
    },
  ],
});

async function leastTelling(engine: LearnEngine): Promise<NearState["window"]> {
  for (const window of WINDOWS) if ((await backwards(engine, { ...PRESET, window })) >= BACKWARDS) return window;
  return PRESET.window;
}
