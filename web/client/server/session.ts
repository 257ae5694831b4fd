/** Live playback: an output clock that styles input frames as they are needed. */

import type { Stylizer } from "../../engine/stylizer";
import type { Styled } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import type { FrameRange, InputInfo, LiveFrame, Reading, ShownFrame, StylizeOptions } from "../protocol";
import { EasedStyles, type StyledStream } from "./eased_styles";
import { median } from "./time_slices";

/** As much of the engine's stylizer as a session needs. */
export type OnlineStylizer = Pick<Stylizer, "classes" | "configure" | "reset" | "push"> & StyledStream;

/** Frames styled before the one that a seek shows: about a second, after which the start has no effect. */
export const WARM_UP_FRAMES = 60;
/** Longest step of the clock: after a sleep playback continues where it was. */
export const MAX_STEP_SECS = 1;
/** Classes that {@link LiveFrame.reads} names. */
const READS = 3;
/** Frames over which the cost of a frame is measured. */
const COST_FRAMES = 61;

/** One styled frame on the output's clock. */
interface Moment {
  inputFrame: number;
  timeSecs: number;
  pose: Float32Array;
  planted: [boolean, boolean];
}

/**
 * One input playing in one database. The input's frame i becomes the styled frame i, which lasts as long as the engine
 * predicts; what is shown lies between two of them.
 */
export class LiveSession {
  /** Whether the clip loops. */
  loop = true;
  /** The input frames that are played; all of them if there is none. */
  range: FrameRange | undefined;

  private previous: Moment | undefined;
  private current: Moment | undefined;
  private clockSecs = 0;
  /** Added to the horizontal root, so that restyling a resting character leaves it where it stands. */
  private place: [x: number, z: number] = [0, 0];
  private readonly styles: EasedStyles;
  /** Whether the options changed after the shown frame was styled. */
  private stale = false;
  private reads: Reading[] = [];
  private readonly costsMs: number[] = [];

  /**
   * @param interpolate pose between two poses, `t` from 0 to 1
   * @param nowMs a clock for the cost of a frame
   */
  constructor(
    private readonly stylizer: OnlineStylizer,
    private readonly input: Pick<InputInfo, "frames" | "rateHz" | "poses">,
    options: StylizeOptions,
    private readonly interpolate: (a: Float32Array, b: Float32Array, t: number) => Float32Array,
    private readonly nowMs: () => number = () => performance.now(),
  ) {
    stylizer.configure(options);
    this.styles = new EasedStyles(stylizer, options);
  }

  /** Takes effect with the next frame; a change of the styles fades in. */
  configure(options: StylizeOptions): void {
    this.styles.setTargets(options);
    this.stylizer.configure(options);
    this.stale = true;
  }

  /** See `StrutClient.step`. */
  step(dtSecs: number): LiveFrame {
    if (!this.current) this.begin(this.firstFrame());
    if (!(dtSecs > 0)) {
      return this.stale ? this.restyle() : this.show(false);
    }
    this.stale = false;
    this.clockSecs += Math.min(dtSecs, MAX_STEP_SECS);
    let looped = false;
    while (this.clockSecs >= this.last().timeSecs) {
      if (this.advance()) continue;
      const overshoot = this.clockSecs - this.last().timeSecs;
      // A clip of one frame has no duration to wrap the clock by.
      if (!this.loop || this.lastFrame() <= this.firstFrame()) {
        this.clockSecs = this.last().timeSecs;
        break;
      }
      this.begin(this.firstFrame());
      this.clockSecs = overshoot;
      looped = true;
    }
    return this.show(looped);
  }

  /** See `StrutClient.seek`: the character stands where the input does. */
  seek(inputFrame: number): LiveFrame {
    this.jump(inputFrame);
    const shown = this.shownPose();
    const input = this.inputPoseAt(this.inputFrame());
    this.moveBy(input[0]! - shown[0]!, input[2]! - shown[2]!);
    return this.show(false);
  }

  /** Goes to an input frame in the place and at the time of a shown one. */
  continueFrom({ inputFrame, timeOut, pose }: ShownFrame): LiveFrame {
    this.jump(inputFrame);
    const now = this.shownPose();
    this.moveBy(pose[0]! - now[0]!, pose[2]! - now[2]!);
    const shift = timeOut - this.clockSecs;
    // Both moments may be one object, before the first frame has a successor.
    for (const moment of new Set([this.previous!, this.current!])) moment.timeSecs += shift;
    this.clockSecs = timeOut;
    return this.show(false);
  }

  /** Makes the shown frame again with the present options. */
  private restyle(): LiveFrame {
    return this.continueFrom({ inputFrame: this.inputFrame(), timeOut: this.clockSecs, pose: this.shownPose() });
  }

  /** Warms the engine up on the frames before `inputFrame` and shows it; time 0 is at its integer part. */
  private jump(inputFrame: number): void {
    const last = this.input.frames - 1;
    const frame = Math.min(Math.max(Number.isFinite(inputFrame) ? inputFrame : 0, 0), last);
    const whole = Math.floor(frame);
    this.styles.arrive(whole);
    this.stale = false;
    this.begin(whole);
    if (frame > whole && this.advance(last)) this.clockSecs = (frame - whole) * this.last().timeSecs;
  }

  /** Resets the engine so that `frame` is shown at time 0. */
  private begin(frame: number): void {
    const first = Math.max(frame - WARM_UP_FRAMES, 0);
    this.stylizer.reset();
    this.place = [0, 0];
    this.clockSecs = 0;
    const styled = this.warmUp(first, frame);
    this.current = { ...lastMoment(styled), inputFrame: frame, timeSecs: 0 };
    this.previous = this.current;
  }

  /** Styles the frames before the one that is shown; with a style track each in its own styles. */
  private warmUp(first: number, frame: number): Styled {
    if (!this.styles.changesOverTime) return this.push(first, frame - first + 1);
    for (let i = first; i < frame; i++) {
      this.styles.arrive(i);
      this.push(i, 1);
    }
    this.styles.arrive(frame);
    return this.push(frame, 1);
  }

  /** Styles one more input frame; false where the last one is reached. */
  private advance(last = this.lastFrame()): boolean {
    const before = this.last();
    const frame = before.inputFrame + 1;
    if (frame > last) return false;
    this.styles.ease(frame, 1 / this.input.rateHz);
    const styled = this.push(frame, 1);
    const moment = lastMoment(styled);
    moment.pose[0]! += this.place[0];
    moment.pose[2]! += this.place[1];
    this.previous = before;
    this.current = { ...moment, inputFrame: frame, timeSecs: before.timeSecs + styled.durations.at(-1)! };
    return true;
  }

  private push(first: number, count: number): Styled {
    const started = this.nowMs();
    const styled = this.stylizer.push(this.input.poses.subarray(first * POSE_FLOATS, (first + count) * POSE_FLOATS));
    this.costsMs.push((this.nowMs() - started) / count);
    if (this.costsMs.length > COST_FRAMES) this.costsMs.shift();
    this.reads = heaviest(this.stylizer.classes, styled.classWeights);
    return styled;
  }

  private firstFrame(): number {
    return Math.min(Math.max(this.range?.first ?? 0, 0), this.input.frames - 1);
  }

  private lastFrame(): number {
    return Math.min(this.range?.last ?? this.input.frames - 1, this.input.frames - 1);
  }

  private moveBy(x: number, z: number): void {
    this.place = [this.place[0] + x, this.place[1] + z];
    for (const moment of new Set([this.previous!, this.current!])) {
      moment.pose[0]! += x;
      moment.pose[2]! += z;
    }
  }

  private last(): Moment {
    return this.current!;
  }

  /** Position of the clock between the last two moments, 0–1. */
  private share(): number {
    const [a, b] = [this.previous!, this.current!];
    const span = b.timeSecs - a.timeSecs;
    return span > 0 ? Math.min(Math.max((this.clockSecs - a.timeSecs) / span, 0), 1) : 1;
  }

  private inputFrame(): number {
    const a = this.previous!.inputFrame;
    return a + (this.last().inputFrame - a) * this.share();
  }

  private shownPose(): Float32Array {
    return this.interpolate(this.previous!.pose, this.last().pose, this.share());
  }

  private inputPoseAt(frame: number): Float32Array {
    const i = Math.floor(frame);
    const j = Math.min(i + 1, this.input.frames - 1);
    const pose = (f: number) => this.input.poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS);
    return this.interpolate(pose(i), pose(j), frame - i);
  }

  private show(looped: boolean): LiveFrame {
    const inputFrame = this.inputFrame();
    return {
      pose: this.shownPose(),
      inputPose: this.inputPoseAt(inputFrame),
      inputFrame,
      timeOut: this.clockSecs,
      planted: (this.share() < 0.5 ? this.previous! : this.last()).planted,
      reads: this.reads,
      frameMs: median(this.costsMs),
      looped,
      ended: !this.loop && inputFrame >= this.lastFrame(),
    };
  }
}

/** The last frame of a batch. */
function lastMoment(styled: Styled): Pick<Moment, "pose" | "planted"> {
  const last = styled.durations.length - 1;
  return {
    pose: styled.poses.slice(last * POSE_FLOATS),
    planted: [styled.planted[2 * last] === 1, styled.planted[2 * last + 1] === 1],
  };
}

/** The heaviest classes, heaviest first; those without weight are left out. */
export function heaviest(classes: Stylizer["classes"], weights: Float32Array): Reading[] {
  return classes
    .map(({ action, style }, i) => ({ action, style, weight: weights[i] ?? 0 }))
    .filter(({ weight }) => weight > 0)
    .sort((a, b) => b.weight - a.weight)
    .slice(0, READS);
}
