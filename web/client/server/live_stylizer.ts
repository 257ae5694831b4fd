/** Styles poses as they arrive; the styles may change between any two of them. */
import { StrutError } from "../../engine/errors";
import type { Styled } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import { MAX_PUSH_FRAMES, type StylizeOptions } from "../protocol";
import { EasedStyles } from "./eased_styles";
import type { OnlineStylizer } from "./session";

export class LiveStylizer {
  readonly #styles: EasedStyles;
  /** Frames since the last reset. */
  #frames = 0;

  /** @param halfLifeSecs half-life of a change of style, 0 for an immediate change */
  constructor(
    private readonly stylizer: OnlineStylizer,
    options: StylizeOptions,
    private readonly rateHz: number,
    halfLifeSecs: number,
  ) {
    stylizer.configure(options);
    this.#styles = new EasedStyles(stylizer, options);
    this.#styles.halfLifeSecs = halfLifeSecs;
  }

  /** Takes effect with the next frame. Refused options change nothing. */
  configure(options: StylizeOptions, halfLifeSecs: number): void {
    const targets = this.#styles.targetsOf(options);
    this.stylizer.configure(options);
    this.#styles.targets = targets;
    this.#styles.halfLifeSecs = halfLifeSecs;
  }

  /** Restarts at the next pose, as after a cut, without a transition of the styles. */
  reset(): void {
    this.stylizer.reset();
    this.#styles.arrive(0);
    this.#frames = 0;
  }

  /**
   * Styles the next poses, `1 / rateHz` apart.
   * @throws StrutError `bad-input` unless it is a whole number of poses, at most {@link MAX_PUSH_FRAMES}
   */
  push(poses: Float32Array): Styled {
    const count = poses.length / POSE_FLOATS;
    if (!Number.isInteger(count) || count < 1 || count > MAX_PUSH_FRAMES) throw badLength(poses.length);
    let done = 0;
    const parts: Styled[] = [];
    while (done < count && !this.#styles.settled) {
      this.#styles.ease(this.#frames, 1 / this.rateHz);
      parts.push(this.#pushFrames(poses, done, 1));
      done += 1;
    }
    if (done < count) parts.push(this.#pushFrames(poses, done, count - done));
    return parts.length === 1 ? parts[0]! : joined(parts);
  }

  #pushFrames(poses: Float32Array, first: number, count: number): Styled {
    this.#frames += count;
    return this.stylizer.push(poses.subarray(first * POSE_FLOATS, (first + count) * POSE_FLOATS));
  }
}

/** Joins batches; the class weights are those of the last frame. */
function joined(parts: readonly Styled[]): Styled {
  const frames = parts.reduce((sum, { durations }) => sum + durations.length, 0);
  const poses = new Float32Array(frames * POSE_FLOATS);
  const durations = new Float32Array(frames);
  const planted = new Uint8Array(2 * frames);
  let frame = 0;
  for (const part of parts) {
    poses.set(part.poses, frame * POSE_FLOATS);
    durations.set(part.durations, frame);
    planted.set(part.planted, 2 * frame);
    frame += part.durations.length;
  }
  return { poses, durations, planted, classWeights: parts.at(-1)!.classWeights };
}

function badLength(length: number): StrutError {
  return new StrutError({
    code: "bad-input",
    message: `${length} numbers were pushed. Expected 1 to ${MAX_PUSH_FRAMES} poses of ${POSE_FLOATS} numbers.`,
    hint: "",
  });
}
