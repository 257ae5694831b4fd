/** Lesson: question an evaluation. */
import type { LearnEngine } from "../client/learn/protocol";
import { trialOf } from "../figures/judge/judge_measure";
import { JUDGE_FIELDS, type JudgeState } from "../figures/judge/judge_state";
import { CONTENT_LEFT, RECORDED, steadiest } from "../figures/judge/recorded";
import type { Measure } from "../figures/kind";
import { initialOf } from "../link/hash";
import equation from "./equations/judge.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(JUDGE_FIELDS);

/** Exercise A: difference in mm that passes, and that is close. */
const BETTER = 0.3;
const BETTER_NEAR = BETTER / 2;
/** Exercise B: a method with an error below this, mm, has seen the answer. */
const SEEN = 1;
/** The bet: differences of the mean error, mm, that count as little, or as some. */
const LITTLE = 0.1;
const SOME = 1;

/** Whether a measure has the two methods and the take of exercise A. */
const isDuel = ({ take, style, leftIn, pick, rival }: Measure) =>
  take === PRESET.take &&
  style === PRESET.style &&
  leftIn === 0 &&
  [pick, rival].sort().join() === [PRESET.rival, PRESET.pick].join().toUpperCase();
const gains = ({ pickGain, rivalGain }: Measure) => [Number(pickGain), Number(rivalGain)];
const isTake = ({ take, style }: Measure) => take === PRESET.take && style === PRESET.style;

/** The frames with the largest advantage of each of the two methods. */
async function solvePins(engine: LearnEngine): Promise<Partial<JudgeState>> {
  const { take, style, pick, rival } = PRESET;
  const [one, other] = await Promise.all([pick, rival].map((method) => trialOf(engine, take, style, false, method)));
  const ahead = Array.from(one!.errors, (error, frame) => other!.errors[frame]! - error);
  return { pickPin: ahead.indexOf(Math.max(...ahead)), rivalPin: ahead.indexOf(Math.min(...ahead)) };
}

export const judge: Lesson = lesson<JudgeState>({
  id: "judge",
  fields: JUDGE_FIELDS,
  figures: [
    { name: "methods", kind: "methods", beats: ["idea", "bet", "look", "exercises", "sources"] },
    { name: "duel", kind: "duel", beats: ["look", "why", "exercises"] },
    { name: "histogram", kind: "histogram", beats: ["look", "why", "sources"] },
  ],
  equation,
  symbols: ["e", "p", "u", "i", "acceleration", "content"],
  bet: {
    options: ["little", "some", "much"],
    reveal: async () => {
      const { methods, otherTake } = RECORDED.inside;
      const known = (mm: number | undefined) => mm ?? Number.NaN;
      const [mar, knn] = [known(methods.get("mar")?.pose), known(methods.get("knn")?.pose)];
      const answer = knn - mar < LITTLE ? "little" : knn - mar <= SOME ? "some" : "much";
      return { answer, measure: { mar, knn, difference: knn - mar, other: known(otherTake) } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "duel",
      start: { ...PRESET },
      pass: (measure) => isDuel(measure) && gains(measure).every((gain) => gain >= BETTER),
      near: (measure) => {
        if (!isDuel(measure)) return "other";
        if (Number(measure.pickPin) < 0) return "noPick";
        if (Number(measure.rivalPin) < 0) return "noRival";
        const [pick, rival] = gains(measure) as [number, number];
        if (Math.min(pick, rival) < BETTER_NEAR) return undefined;
        return pick < BETTER ? "pick" : "rival";
      },
      refuse: (measure) => isDuel(measure) && gains(measure).some((gain) => gain < 0),
      solve: solvePins,
    },
    {
      id: "B",
      figure: "methods",
      start: { ...PRESET, pick: "nn" },
      pass: (measure) =>
        isTake(measure) && measure.leftIn === 1 && Number(measure.in) < SEEN && measure.honest === "out",
      near: (measure) => {
        if (!isTake(measure)) return "other";
        if (measure.leftIn !== 1) return "leave";
        return measure.honest === "" ? "tick" : undefined;
      },
      refuse: ({ honest }) => honest === "in",
      solve: async () => ({ leftIn: true, honest: "out" }),
    },
    {
      id: "C",
      figure: "methods",
      start: { ...PRESET, pick: "nn" },
      pass: ({ source, pick, steadiest }) => source === "off" && pick === steadiest,
      near: ({ source, acceleration }) => {
        if (source !== "off") return "other";
        return Number.isNaN(acceleration) ? "unmeasured" : undefined;
      },
      refuse: ({ source, content }) => source === "off" && Number(content) < CONTENT_LEFT,
      solve: async () => ({ source: "off", pick: steadiest(RECORDED.off) ?? PRESET.pick }),
    },
  ],
});
