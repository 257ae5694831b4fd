/** Lesson: predict the effects of variances. */
import type { LearnEngine } from "../client/learn/protocol";
import { cadenceOf, jerkOf, measureChain, pathOf, plainOf } from "../figures/chain/chain_measure";
import { CHAIN_FIELDS, CHAIN_RANGES, type ChainState } from "../figures/chain/chain_state";
import type { Measure } from "../figures/kind";
import { initialOf } from "../link/hash";
import equation from "./equations/chain.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(CHAIN_FIELDS);

/** Exercise A: distances from the means that pass, and that are close, degrees. */
const DEGREES_OFF = 2;
const DEGREES_NEAR = 4;
/** Exercise B: its joint, the remaining share of the jerk, deviations from the means, and the tolerances of a near miss. */
const TOES = "left_toes";
const JERK = 0.5;
const DEVIATIONS = 2.2;
const CLOSE = 1.2;
/** Exercise C: steps per minute, and the tolerances of a pass and of a near miss. */
const CADENCE = 100;
const CADENCE_OFF = 1;
const CADENCE_NEAR = 3;
/** The bet: the factor of a variance, and shares of the jerk that count as unchanged. */
const SMALLER = 0.1;
const SAME = 0.03;

const isPlain = ({ share, style }: Measure) => share === PRESET.share || style === "neutral";
const isOf = (measure: Measure, joint: string) => isPlain(measure) && measure.joint === joint && measure.axis === "x";
/** Whether a variance of the pose, or of changes, was moved in the wrong direction for exercise A. */
const isLoosened = ({ pose, velocity, acceleration }: Measure) =>
  Number(pose) > 1 || Number(velocity) < 1 || Number(acceleration) < 1;

export const chain: Lesson = lesson<ChainState>({
  id: "chain",
  fields: CHAIN_FIELDS,
  figures: [
    { name: "path", kind: "path", beats: ["bet", "look", "exercises"] },
    { name: "chain", kind: "chain", beats: ["look", "why", "exercises"] },
    { name: "gait", kind: "gait", beats: ["idea", "look", "why", "sources"] },
  ],
  decimals: { farthest: 1, cadence: 1 },
  equation,
  symbols: ["c", "mu", "sigma", "delta", "d", "rho", "k"],
  bet: {
    options: ["smoother", "same", "rougher"],
    reveal: async (engine) => {
      const shareOf = async (joint: ChainState["joint"]) => {
        const state = { ...PRESET, joint, acceleration: SMALLER };
        const [path, plain] = await Promise.all([pathOf(engine, state), plainOf(engine, state)]);
        return jerkOf(path) / jerkOf(plain);
      };
      const [leg, toes] = (await Promise.all([PRESET.joint, TOES as ChainState["joint"]].map(shareOf))) as [
        number,
        number,
      ];
      const answer = leg < 1 - SAME ? "smoother" : leg > 1 + SAME ? "rougher" : "same";
      return { answer, measure: { leg, toes } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "path",
      start: { ...PRESET },
      pass: (measure) => isOf(measure, PRESET.joint) && Number(measure.farthest) <= DEGREES_OFF,
      near: (measure) => {
        if (!isOf(measure, PRESET.joint)) return "other";
        return Number(measure.farthest) <= DEGREES_NEAR ? "further" : undefined;
      },
      refuse: (measure) =>
        isOf(measure, PRESET.joint) && Number(measure.farthest) > DEGREES_NEAR && isLoosened(measure),
      solve: async () => ({ pose: CHAIN_RANGES.pose.min }),
    },
    {
      id: "B",
      figure: "path",
      start: { ...PRESET, joint: TOES },
      pass: (measure) =>
        isOf(measure, TOES) && Number(measure.jerkShare) <= JERK && Number(measure.deviations) <= DEVIATIONS,
      near: (measure) => {
        if (!isOf(measure, TOES)) return "other";
        if (Number(measure.jerkShare) <= JERK && Number(measure.deviations) <= CLOSE * DEVIATIONS) return "far";
        if (Number(measure.jerkShare) <= CLOSE * JERK && Number(measure.deviations) <= DEVIATIONS) return "rough";
        return undefined;
      },
      refuse: (measure) =>
        isOf(measure, TOES) && Number(measure.jerkShare) <= JERK && Number(measure.deviations) > CLOSE * DEVIATIONS,
      solve: async (engine) => ({ acceleration: await gentlest(engine) }),
    },
    {
      id: "C",
      figure: "chain",
      start: { ...PRESET },
      pass: (measure) => isPlain(measure) && Math.abs(Number(measure.cadence) - CADENCE) <= CADENCE_OFF,
      near: (measure) => {
        if (!isPlain(measure)) return "other";
        if (Math.abs(Number(measure.cadence) - CADENCE) > CADENCE_NEAR) return undefined;
        return Number(measure.cadence) > CADENCE ? "longer" : "shorter";
      },
      refuse: (measure) => isPlain(measure) && Number(measure.left) + Number(measure.right) < 0,
      solve: async (engine) => {
        let [low, high] = [0, CHAIN_RANGES.left.max] as [number, number];
        while (high - low > 0.5 * 10 ** -CHAIN_RANGES.left.digits) {
          const rho = (low + high) / 2;
          if (cadenceOf(await pathOf(engine, { ...PRESET, left: rho, right: rho })) > CADENCE) low = rho;
          else high = rho;
        }
        return { left: high, right: high };
      },
    },
  ],
});

/** The largest factor of σ″², in steps of a twentieth of a decade, with which the jerk is halved. */
async function gentlest(engine: LearnEngine): Promise<number> {
  for (let tenths = 0; ; tenths++) {
    const acceleration = Number((10 ** (-tenths / 20)).toFixed(CHAIN_RANGES.acceleration.digits));
    const { jerkShare } = await measureChain(engine, { ...PRESET, joint: TOES, acceleration });
    if (Number(jerkShare) <= JERK || acceleration <= CHAIN_RANGES.acceleration.min) return acceleration;
  }
}
