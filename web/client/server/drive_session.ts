/** Driving: neutral frames that a driver makes as they are needed, each styled at once. */
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

/** Longest line to follow: its points are thinned by the engine. */
const MAX_PATH_FLOATS = 200_000;
/** Most frames that are kept as an input: five minutes at 60 Hz. */
const MAX_KEPT_SECS = 300;

/** A styled frame with what was driven for it. */
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

/** As much of the engine's driver as a session needs. */
export type NeutralDriver = Pick<Driver, "next" | "reset" | "clips" | "progress"> & { path: Float32Array };

export class DriveSession {
  private readonly styles: EasedStyles;
  private readonly clock: OutputClock<DrivenMoment>;
  private readonly cost: FrameCost;
  private control = STILL;
  /** A move that was asked for since the last frame. */
  private action: Move | undefined;
  /** Frames that were driven. */
  private frames = 0;
  /** Those in which another row than the next one was taken, of the last second. */
  private switches: number[] = [];
  /** Added to the horizontal root of what is styled: so that restyling leaves the character where it stands. */
  private place: [x: number, z: number] = [0, 0];
  private recording: Recording;
  private stale = false;
  private reads: Reading[] = [];

  /**
   * @param names of the styles
   * @param inputStyle the style in which the driver moves, if the database has it; else empty
   * @param interpolate pose between two poses
   * @param root where it begins
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

  /** Takes effect with the next frame; a change of the styles fades in. What is refused changes nothing. */
  configure(options: StylizeOptions): void {
    const driven = this.ofDriven(options);
    this.stylizer.configure(driven);
    this.styles.setTargets(driven);
    this.stale = true;
  }

  /** Begins anew at a place, in the present styles; what was driven before is forgotten. */
  reset(root: Root): void {
    this.driver.reset(...root);
    this.stylizer.reset();
    this.styles.arrive(0);
    this.recording = new Recording(this.names);
    this.place = [0, 0];
    [this.frames, this.switches, this.control] = [0, [], STILL];
    this.clock.begin({ ...this.advanced(undefined), timeSecs: 0 });
  }

  /** Goes on by a time as it is asked to; with no time the present instant is shown in the present style. */
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

  /** The neutral frames, and the styles that they were shown in. */
  driven(): Pick<Recording, "frames"> & { poses: Float32Array; track: ReturnType<Recording["track"]> } {
    const frames = Math.min(this.recording.frames, MAX_KEPT_SECS * this.rateHz);
    return { frames, poses: this.recording.last(frames), track: this.recording.track(frames) };
  }

  /** Options for what is driven: a track and labels are of another input. */
  private ofDriven(options: StylizeOptions): StylizeOptions {
    return { ...options, track: [], action: "", inputStyle: this.inputStyle };
  }

  /** A control with what is no number counts as the last good one, and such a path as none. */
  private take(control: DriveControl): void {
    const { path } = control;
    const isLine = path && path.length !== 2 && path.length <= MAX_PATH_FLOATS && path.every(Number.isFinite);
    if (isLine) this.driver.path = path;
    this.action = control.action ?? this.action;
    if (isControl(control)) this.control = control;
  }

  /** Drives and styles one more frame; its time is how long it lasts. */
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

  /** Makes the shown frame again with the present options: the engine is warmed up on the frames before it. */
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
      // What is shown is transferred.
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
