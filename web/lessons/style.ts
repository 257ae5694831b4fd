/** Lesson: distinguish content from style. */

import type { LearnEngine } from "../client/learn/protocol";
import type { Measure } from "../figures/kind";
import { farthestJoint, jointMeans, nearestStyle, styleMeans } from "../figures/pair_measure";
import { PAIR_FIELDS, type PairState } from "../figures/pair_state";
import { meanOf, type Pair } from "../figures/pairing";
import { sharedPair } from "../figures/shared";
import { ROLES } from "../humanoid";
import { initialOf } from "../link/hash";
import equation from "./equations/style.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(PAIR_FIELDS);

/** Exercise B: its style, and the required ratio to the difference by content. */
const SLOWER = "sexy";
const TIMES = 4;
/** Half of it is a near miss. */
const TIMES_NEAR = 2;
/** Exercise C: this share of the largest difference is a near miss. */
const NEAR_JOINT = 0.7;

/** Joints that move far in every walk. */
const TRAVELLING = /_(foot|toes|lower_leg)$/;

const ratio = (measure: Measure) => Number(measure.second) / Number(measure.content);
/** Whether the displayed value is the mean of all joints, for a style of the lesson's own walk. */
const isMeanOf = ({ motion, style, joint }: Measure, wanted: PairState["style"]) =>
  motion === PRESET.motion && style === wanted && joint === "";
const isPair = ({ motion, style }: Measure) => motion === PRESET.motion && style === "old";

/** The input and its performance in a style. @throws Error if the engine has none */
async function pairOfStyle(engine: LearnEngine, style: PairState["style"]): Promise<Pair> {
  const pair = await sharedPair(engine, PRESET.motion, style);
  if (!pair) throw new Error(`The engine has no performance in the style “${style}”.`);
  return pair;
}

export const style: Lesson = lesson<PairState>({
  id: "style",
  fields: PAIR_FIELDS,
  figures: [
    {
      name: "stage",
      kind: "stage",
      explained: ["look", "why", "exercises"],
    },
    {
      name: "curve",
      kind: "curve",
      beats: ["look", "why", "exercises", "sources"],
      explained: ["look", "why", "exercises"],
    },
  ],
  equation,
  symbols: ["e", "p", "q", "tau", "i", "J"],
  bet: {
    options: ["second", "content"],
    reveal: async (engine) => {
      const { difference } = await pairOfStyle(engine, PRESET.style);
      const [second, content] = [meanOf(difference.second), meanOf(difference.content)];
      return { answer: second > content ? "second" : "content", measure: { second, content } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "curve",
      start: { ...PRESET },
      pass: ({ motion, style, nearest }) => motion === PRESET.motion && style === nearest,
      near: ({ motion, style }) => (motion !== PRESET.motion || style === "neutral" ? "other" : undefined),
      refuse: ({ style, nearestBySecond, motion }) => motion === PRESET.motion && style === nearestBySecond,
      solve: async (engine) => ({
        style: nearestStyle(await styleMeans(engine, PRESET.motion, "content")) as PairState["style"],
      }),
    },
    {
      id: "B",
      figure: "curve",
      start: { ...PRESET, style: SLOWER, at: 0 },
      pass: (measure) => isMeanOf(measure, SLOWER) && ratio(measure) >= TIMES,
      near: (measure) => {
        if (!isMeanOf(measure, SLOWER)) return "other";
        if (ratio(measure) < TIMES_NEAR) return undefined;
        return Number(measure.ratioAfter) >= Number(measure.ratioBefore) ? "later" : "earlier";
      },
      refuse: (measure) => isMeanOf(measure, SLOWER) && Number(measure.second) <= Number(measure.content),
      solve: async (engine) => {
        const { difference } = await pairOfStyle(engine, SLOWER);
        const at = difference.content.findIndex((content, f) => difference.second[f]! >= TIMES * content);
        return { at };
      },
    },
    {
      id: "C",
      figure: "curve",
      start: { ...PRESET },
      pass: (measure) => isPair(measure) && measure.joint === measure.farthest,
      near: (measure) => {
        const { joint, jointMean, farthestMean } = measure;
        if (!isPair(measure)) return "other";
        if (joint === "") return "none";
        return Number(jointMean) >= NEAR_JOINT * Number(farthestMean) ? "close" : undefined;
      },
      refuse: (measure) => isPair(measure) && TRAVELLING.test(String(measure.joint)),
      solve: async (engine) => ({
        joint: ROLES[farthestJoint(jointMeans(await pairOfStyle(engine, "old"), "content"))]!,
      }),
    },
  ],
});
