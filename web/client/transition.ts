/** The fade from a pose that was shown to what takes its place: its difference is added at first, and halves again and again. */
import { exp, inverse, JOINTS, log, multiply, quaternionAt, type Vector } from "../humanoid";

/** Time in which the difference halves, seconds. */
const HALF_LIFE_SECS = 0.08;
/** A share of the difference that cannot be seen. */
const INVISIBLE = 2e-3;

export class Transition {
  /** What is added to the height of the root, metres, and turns each joint. */
  private constructor(
    private readonly height: number,
    private readonly turns: readonly Vector[],
  ) {}

  /** From one pose to another in the same place. */
  static between(shown: Float32Array, next: Float32Array): Transition {
    const turns = Array.from({ length: JOINTS }, (_, joint) =>
      log(multiply(rotation(shown, joint), inverse(rotation(next, joint)))),
    );
    return new Transition(shown[1]! - next[1]!, turns);
  }

  /** Changes a pose to what is shown of it `secs` after the beginning; false where there is nothing left to change. */
  apply(pose: Float32Array, secs: number): boolean {
    const share = 0.5 ** (Math.max(0, secs) / HALF_LIFE_SECS);
    if (share < INVISIBLE) return false;
    pose[1]! += share * this.height;
    for (const [joint, [x, y, z]] of this.turns.entries())
      pose.set(multiply(exp([share * x, share * y, share * z]), rotation(pose, joint)), 3 + 4 * joint);
    return true;
  }
}

function rotation(pose: Float32Array, joint: number) {
  return quaternionAt(pose.subarray(3), joint);
}
