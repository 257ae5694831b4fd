/** The fade from a displayed pose to the motion that replaces it: the difference is added and decays exponentially. */
import { exp, inverse, JOINTS, log, multiply, quaternionAt, type Vector } from "../humanoid";

/** Half-life of the difference, seconds. */
const HALF_LIFE_SECS = 0.08;
/** A share of the difference that is invisible. */
const INVISIBLE = 2e-3;

export class Transition {
  /** Offset of the root's height, metres, and rotation of each joint. */
  private constructor(
    private readonly height: number,
    private readonly turns: readonly Vector[],
  ) {}

  /** A transition from one pose to another at the same position. */
  static between(shown: Float32Array, next: Float32Array): Transition {
    const turns = Array.from({ length: JOINTS }, (_, joint) =>
      log(multiply(rotation(shown, joint), inverse(rotation(next, joint)))),
    );
    return new Transition(shown[1]! - next[1]!, turns);
  }

  /** Adds the remaining difference to a pose, `secs` after the beginning. Returns false if there is none left. */
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
