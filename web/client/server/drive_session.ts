/** Driving: a driver makes neutral frames on demand, each styled at once. */
import type { Driver, DriverFrame } from "../../engine/drive/driver";
import type { Stylizer } from "../../engine/stylizer";
import type { Styled } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import { type DriveControl, type DriveFrame, isControl, type Move, type Root, STILL } from "../drive/protocol";
import type { Reading, StylizeOptions } from "../protocol";
import { heaviest } from "../readings";
import { EasedStyles } from "./eased_styles";
import { FrameCost } from "./frame_cost";
import { type Interpolate, type Moment, OutputClock } from "./output_clock";
import { Recording } from "./recording";
import { lastMoment, type OnlineStylizer, WARM_UP_FRAMES } from "./session";

/** Longest path, in floats; the engine thins its points. */
const MAX_PATH_FLOATS = 200_000;
/** Maximum duration of the frames that are kept as an input: five minutes at 60 Hz. */
const MAX_KEPT_SECS = 300;

/** A styled frame with its driving state. */
interface DrivenMoment extends Moment {
  neutral: Float32Array;
  root: Root;
  asked: Float32Array;
  ahead: Float32Array;
  speed: number;
  clip: number;
  row: number;
  move: Move | undefined;
}

/** The part of the engine's driver that a session needs. */
export type NeutralDriver = Pick<Driver, "next" | "reset" | "clips" | "progress"> & { path: Float32Array };

export class DriveSession {
  private readonly styles: EasedStyles;
  private readonly clock: OutputClock<DrivenMoment>;
  private readonly cost: FrameCost;
  private control = STILL;
  /** A move requested since the last frame. */
  private action: Move | undefined;
  /** Number of driven frames. */
  private frames = 0;
  /** Frames of the last second in which the driver jumped to a row other than the next one. */
  private switches: number[] = [];
  /** Offset added to the horizontal root of the styled pose, so that restyling leaves the character at its position. */
  private place: [x: number, z: number] = [0, 0];
  private recording: Recording;
  private stale = false;
  private reads: Reading[] = [];

  /**
   * @param names names of the styles
   * @param inputStyle the style in which the driver moves, if the database has it; else empty
   * @param interpolate pose between two poses
   * @param root initial root
   * @param nowMs a clock for the cost of a frame
   */
  constructor(
    private readonly stylizer: OnlineStylizer & Pick<Stylizer, "setStyleShare">,
    private readonly driver: NeutralDriver,
    private readonly names: readonly string[],
    private readonly rateHz: number,
    private readonly inputStyle: string,
    options: StylizeOptions,
    interpolate: Interpolate,
    root: Root,
    nowMs?: () => number,
  ) {
    const driven = this.ofDriven(options);
    stylizer.configure(driven);
    this.styles = new EasedStyles(stylizer, driven);
    this.clock = new OutputClock(interpolate);
    this.cost = new FrameCost(nowMs);
    this.recording = new Recording(names);
    this.reset(root);
  }

  /** Takes effect with the next frame; a change of the styles fades in. Refused options change nothing. */
  configure(options: StylizeOptions): void {
    const driven = this.ofDriven(options);
    const targets = this.styles.targetsOf(driven);
    this.stylizer.configure(driven);
    this.styles.targets = targets;
    this.stale = true;
  }

  /** Restarts at a position, in the current styles. The recording is discarded. */
  reset(root: Root): void {
    this.driver.reset(...root);
    this.stylizer.reset();
    this.styles.arrive(0);
    this.recording = new Recording(this.names);
    this.place = [0, 0];
    [this.frames, this.switches, this.control] = [0, [], STILL];
    this.clock.begin({ ...this.advanced(undefined), timeSecs: 0 });
  }

  /** Advances by a duration as steered; a duration of 0 shows the current instant in the current style. */
  drive(dtSecs: number, control: DriveControl): DriveFrame {
    this.take(control);
    if (dtSecs > 0) {
      this.stale = false;
      this.clock.advance(dtSecs);
      while (this.clock.isAhead) {
        const { timeSecs, pose } = this.clock.last;
        const moment = this.advanced([pose[0]!, pose[2]!]);
        this.clock.push({ ...moment, timeSecs: timeSecs + moment.timeSecs });
      }
    } else if (this.stale) this.restyle();
    return this.shown();
  }

  /** The neutral frames, and the styles in which they were displayed. */
  driven(): Pick<Recording, "frames"> & { poses: Float32Array; track: ReturnType<Recording["track"]> } {
    const frames = Math.min(this.recording.frames, MAX_KEPT_SECS * this.rateHz);
    return { frames, poses: this.recording.last(frames), track: this.recording.track(frames) };
  }

  /** Options for the driven motion: a track and labels belong to another input. */
  private ofDriven(options: StylizeOptions): StylizeOptions {
    return { ...options, track: [], action: "", inputStyle: this.inputStyle };
  }

  /** An invalid control is replaced by the last valid one, and an invalid path is ignored. */
  private take(control: DriveControl): void {
    const { path } = control;
    const isLine = path && path.length !== 2 && path.length <= MAX_PATH_FLOATS && path.every(Number.isFinite);
    if (isLine) this.driver.path = path;
    this.action = control.action ?? this.action;
    if (isControl(control)) this.control = control;
  }

  /** Drives and styles one more frame; its time is its duration. */
  private advanced(styledHips: readonly [x: number, z: number] | undefined): DrivenMoment {
    const { move, gait, face } = this.control;
    const driven = this.driver.next({ move, gait, face, action: this.action }, styledHips);
    this.action = undefined;
    this.stylizer.setStyleShare(driven.styleShare);
    this.styles.ease(this.frames, 1 / this.rateHz);
    this.recording.add(driven.pose, this.styles.whole);
    if (driven.switched) this.switches.push(this.frames);
    this.switches = this.switches.filter((frame) => frame > this.frames - this.rateHz);
    const moment = this.momentOf(driven, this.push(driven.pose));
    this.frames += 1;
    return moment;
  }

  /** Remakes the displayed frame with the current options. The engine is warmed up on the frames before it. */
  private restyle(): void {
    this.stale = false;
    const { pose } = this.clock;
    this.stylizer.reset();
    this.styles.arrive(this.frames);
    this.clock.repose(this.push(this.recording.last(WARM_UP_FRAMES)).poses, POSE_FLOATS);
    const again = this.clock.pose;
    this.place = [pose[0]! - again[0]!, pose[2]! - again[2]!];
    this.clock.moveBy(...this.place);
  }

  private push(poses: Float32Array): Styled {
    const styled = this.cost.measure(1, () => this.stylizer.push(poses));
    this.reads = heaviest(this.stylizer.classes, styled.classWeights);
    return styled;
  }

  private momentOf(driven: DriverFrame, styled: Styled): DrivenMoment {
    const moment = lastMoment(styled);
    moment.pose[0]! += this.place[0];
    moment.pose[2]! += this.place[1];
    const [x, z, heading] = driven.root;
    return {
      ...moment,
      inputFrame: this.frames,
      timeSecs: styled.durations.at(-1)!,
      neutral: driven.planted.slice(),
      root: [x!, z!, heading!],
      asked: driven.asked.slice(),
      ahead: driven.ahead.slice(),
      speed: driven.speed,
      clip: driven.clip,
      row: driven.row,
      move: driven.move,
    };
  }

  private shown(): DriveFrame {
    const { clock } = this;
    const { root, asked, ahead, speed, clip, row, move } = clock.last;
    return {
      pose: clock.pose,
      inputPose: clock.between(({ neutral }) => neutral),
      inputFrame: clock.inputFrame,
      timeOut: clock.secs,
      planted: clock.nearest.planted,
      reads: this.reads,
      frameMs: this.cost.ms,
      looped: false,
      ended: false,
      root,
      // Displayed data is transferred.
      asked: asked.slice(),
      ahead: ahead.slice(),
      speed,
      clip: this.driver.clips[clip] ?? "",
      row,
      transitions: this.switches.length,
      progress: this.driver.progress,
      move,
    };
  }
}
