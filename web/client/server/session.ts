/** Live playback: an output clock that styles input frames on demand. */

import type { Stylizer } from "../../engine/stylizer";
import type { Styled } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import type { FrameRange, InputInfo, LiveFrame, Reading, ShownFrame, StylizeOptions } from "../protocol";
import { heaviest } from "../readings";
import { EasedStyles, type StyledStream } from "./eased_styles";
import { FrameCost } from "./frame_cost";
import { type Interpolate, type Moment, OutputClock } from "./output_clock";

/** The part of the engine's stylizer that a session needs. */
export type OnlineStylizer = Pick<Stylizer, "classes" | "configure" | "reset" | "push"> & StyledStream;

/** Frames styled before the one that a seek displays: about a second, after which the start has no effect. */
export const WARM_UP_FRAMES = 60;

/**
 * One input playing in one database. The input's frame i becomes the styled frame i, which lasts as long as the engine
 * predicts. The displayed pose lies between two styled frames.
 */
export class LiveSession {
  /** Whether the clip loops. */
  loop = true;
  /** The input frames that are played; all frames if `undefined`. */
  range: FrameRange | undefined;

  readonly #clock: OutputClock;
  /** Offset added to the horizontal root, so that restyling a paused character leaves it at its position. */
  #place: [x: number, z: number] = [0, 0];
  readonly #styles: EasedStyles;
  /** Whether the options changed after the displayed frame was styled. */
  #stale = false;
  #reads: Reading[] = [];
  readonly #cost: FrameCost;

  /**
   * @param interpolate pose between two poses, `t` from 0 to 1
   * @param nowMs a clock for the cost of a frame
   */
  constructor(
    private readonly stylizer: OnlineStylizer,
    private readonly input: Pick<InputInfo, "frames" | "rateHz" | "poses">,
    options: StylizeOptions,
    private readonly interpolate: Interpolate,
    nowMs?: () => number,
  ) {
    stylizer.configure(options);
    this.#styles = new EasedStyles(stylizer, options);
    this.#clock = new OutputClock(interpolate);
    this.#cost = new FrameCost(nowMs);
  }

  /** Takes effect with the next frame; a change of the styles fades in. Refused options change nothing. */
  configure(options: StylizeOptions): void {
    const targets = this.#styles.targetsOf(options);
    this.stylizer.configure(options);
    this.#styles.targets = targets;
    this.#stale = true;
  }

  /** See `StrutClient.step`. */
  step(dtSecs: number): LiveFrame {
    const clock = this.#clock;
    if (!clock.hasBegun) this.#begin(this.#firstFrame());
    if (!(dtSecs > 0)) {
      return this.#stale ? this.#restyle() : this.#show(false);
    }
    this.#stale = false;
    clock.advance(dtSecs);
    let looped = false;
    while (clock.isAhead) {
      if (this.#advance()) continue;
      const overshoot = clock.secs - clock.last.timeSecs;
      // A clip of one frame has no duration by which the clock could wrap.
      if (!this.loop || this.#lastFrame() <= this.#firstFrame()) {
        clock.secs = clock.last.timeSecs;
        break;
      }
      this.#begin(this.#firstFrame());
      clock.secs = overshoot;
      looped = true;
    }
    return this.#show(looped);
  }

  /** See `StrutClient.seek`: the character is at the input's position. */
  seek(inputFrame: number): LiveFrame {
    this.#jump(inputFrame);
    const shown = this.#clock.pose;
    const input = this.#inputPoseAt(this.#clock.inputFrame);
    this.#moveBy(input[0]! - shown[0]!, input[2]! - shown[2]!);
    return this.#show(false);
  }

  /** Jumps to an input frame, at the position and the time of a displayed one. */
  continueFrom({ inputFrame, timeOut, pose }: ShownFrame): LiveFrame {
    this.#jump(inputFrame);
    const now = this.#clock.pose;
    this.#moveBy(pose[0]! - now[0]!, pose[2]! - now[2]!);
    this.#clock.delay(timeOut - this.#clock.secs);
    return this.#show(false);
  }

  /** Remakes the displayed frame with the current options. */
  #restyle(): LiveFrame {
    const { inputFrame, secs: timeOut, pose } = this.#clock;
    return this.continueFrom({ inputFrame, timeOut, pose });
  }

  /** Warms the engine up on the frames before `inputFrame` and displays it; time 0 is at its integer part. */
  #jump(inputFrame: number): void {
    const last = this.input.frames - 1;
    const frame = Math.min(Math.max(Number.isFinite(inputFrame) ? inputFrame : 0, 0), last);
    const whole = Math.floor(frame);
    this.#styles.arrive(whole);
    this.#stale = false;
    this.#begin(whole);
    if (frame > whole && this.#advance(last)) this.#clock.secs = (frame - whole) * this.#clock.last.timeSecs;
  }

  /** Resets the engine so that `frame` is displayed at time 0. */
  #begin(frame: number): void {
    const first = Math.max(frame - WARM_UP_FRAMES, 0);
    this.stylizer.reset();
    this.#place = [0, 0];
    const styled = this.#warmUp(first, frame);
    this.#clock.begin({ ...lastMoment(styled), inputFrame: frame, timeSecs: 0 });
  }

  /** Styles the frames before the displayed one; with a style track each in its own styles. */
  #warmUp(first: number, frame: number): Styled {
    if (!this.#styles.changesOverTime) return this.#push(first, frame - first + 1);
    for (let i = first; i < frame; i++) {
      this.#styles.arrive(i);
      this.#push(i, 1);
    }
    this.#styles.arrive(frame);
    return this.#push(frame, 1);
  }

  /** Styles one more input frame. Returns false if the last one is reached. */
  #advance(last = this.#lastFrame()): boolean {
    const before = this.#clock.last;
    const frame = before.inputFrame + 1;
    if (frame > last) return false;
    this.#styles.ease(frame, 1 / this.input.rateHz);
    const styled = this.#push(frame, 1);
    const moment = lastMoment(styled);
    moment.pose[0]! += this.#place[0];
    moment.pose[2]! += this.#place[1];
    this.#clock.push({ ...moment, inputFrame: frame, timeSecs: before.timeSecs + styled.durations.at(-1)! });
    return true;
  }

  #push(first: number, count: number): Styled {
    const poses = this.input.poses.subarray(first * POSE_FLOATS, (first + count) * POSE_FLOATS);
    const styled = this.#cost.measure(count, () => this.stylizer.push(poses));
    this.#reads = heaviest(this.stylizer.classes, styled.classWeights);
    return styled;
  }

  #firstFrame(): number {
    return Math.min(Math.max(this.range?.first ?? 0, 0), this.input.frames - 1);
  }

  #lastFrame(): number {
    return Math.min(this.range?.last ?? this.input.frames - 1, this.input.frames - 1);
  }

  #moveBy(x: number, z: number): void {
    this.#place = [this.#place[0] + x, this.#place[1] + z];
    this.#clock.moveBy(x, z);
  }

  #inputPoseAt(frame: number): Float32Array {
    const i = Math.floor(frame);
    const j = Math.min(i + 1, this.input.frames - 1);
    const pose = (f: number) => this.input.poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS);
    return this.interpolate(pose(i), pose(j), frame - i);
  }

  #show(looped: boolean): LiveFrame {
    const { inputFrame } = this.#clock;
    return {
      pose: this.#clock.pose,
      inputPose: this.#inputPoseAt(inputFrame),
      inputFrame,
      timeOut: this.#clock.secs,
      planted: this.#clock.nearest.planted,
      reads: this.#reads,
      frameMs: this.#cost.ms,
      looped,
      ended: !this.loop && inputFrame >= this.#lastFrame(),
    };
  }
}

/** The last frame of a batch. */
export function lastMoment(styled: Styled): Pick<Moment, "pose" | "planted"> {
  const last = styled.durations.length - 1;
  return {
    pose: styled.poses.slice(last * POSE_FLOATS),
    planted: [styled.planted[2 * last] === 1, styled.planted[2 * last + 1] === 1],
  };
}
