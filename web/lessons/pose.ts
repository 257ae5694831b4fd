/** Lesson: read a degree of freedom. */
import type { LearnEngine } from "../client/learn/protocol";
import type { Measure } from "../figures/kind";
import { changedNumbers, DOFS, meanOf, measurePose, motionOf, rotationAt } from "../figures/pose/pose_measure";
import { POSE_FIELDS, POSE_RANGES, type PoseState } from "../figures/pose/pose_state";
import { withTurn } from "../figures/turned_joints";
import { inverse, log, multiply } from "../humanoid";
import { initialOf } from "../link/hash";
import equation from "./equations/pose.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(POSE_FIELDS);

/** Exercise A: its joint, the size of a jump, radians, and the φ from which on it is close, degrees. */
const THIGH = "left_upper_leg";
const JUMP = 1.5;
const CLOSE = 150;
/** Exercise B: tolerance from the mean, degrees. */
const OFF = 3;
/** The bet: rotation of the walker, degrees, and the number of changed values that counts as few. */
const TURN = 90;
const FEW = 4;

const isPlain = ({ motion, joint, turned, heading }: Measure, of: PoseState["joint"]) =>
  motion === PRESET.motion && joint === of && turned === 0 && heading === "0";
const isKnee = ({ motion, joint, at }: Measure) =>
  motion === PRESET.motion && joint === PRESET.joint && at === PRESET.at;

export const pose: Lesson = lesson<PoseState>({
  id: "pose",
  fields: POSE_FIELDS,
  figures: [
    { name: "joint", kind: "joint" },
    { name: "numbers", kind: "numbers", beats: ["look", "sources"] },
    { name: "logs", kind: "logs", beats: ["why", "exercises"] },
  ],
  equation,
  symbols: ["w", "mean", "R", "h", "v", "psi"],
  bet: {
    options: ["none", "few", "all"],
    reveal: async (engine) => {
      const changed = await changedNumbers(engine, { ...PRESET, heading: TURN });
      const answer = changed === 0 ? "none" : changed <= FEW ? "few" : "all";
      return { answer, measure: { changed: String(changed), of: String(DOFS), turn: String(TURN) } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "logs",
      start: { ...PRESET, joint: THIGH },
      pass: (measure) => isPlain(measure, THIGH) && Number(measure.rawJump) > JUMP && Number(measure.jump) <= JUMP,
      near: (measure) => {
        if (!isPlain(measure, THIGH)) return "other";
        return Number(measure.phi) >= CLOSE ? "further" : undefined;
      },
      refuse: (measure) => isPlain(measure, THIGH) && Number(measure.phi) < CLOSE && Number(measure.rawJump) <= JUMP,
      solve: async (engine) => ({ phi: await leastJumping(engine) }),
    },
    {
      id: "B",
      figure: "joint",
      start: { ...PRESET },
      pass: (measure) => isKnee(measure) && Number(measure.angle) <= OFF,
      near: (measure) => {
        if (!isKnee(measure)) return "other";
        if (Number(measure.angle) > 2 * OFF) return undefined;
        // A drag in the picture's plane also rotates about other axes.
        if (Number(measure.aside) > Math.abs(Number(measure.bend))) return "aside";
        return Number(measure.bend) < 0 ? "bend" : "stretch";
      },
      refuse: (measure) => isKnee(measure) && Number(measure.straight) <= OFF,
      solve: async (engine) => {
        const motion = await motionOf(engine, PRESET.motion, [], 0);
        const { joint, at } = PRESET;
        const turn = log(multiply(meanOf(motion, joint), inverse(rotationAt(motion, joint, at))));
        return { turned: withTurn([], joint, turn) };
      },
    },
  ],
});

/** The smallest φ, in steps of five degrees, at which the raw logarithm jumps. */
async function leastJumping(engine: LearnEngine): Promise<number> {
  const { max } = POSE_RANGES.phi;
  for (let phi = 0; phi < max; phi += 5) {
    const { rawJump } = await measurePose(engine, { ...PRESET, joint: THIGH, phi });
    if (Number(rawJump) > JUMP) return phi;
  }
  return max;
}
