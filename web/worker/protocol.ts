/**
 * What the page and the worker say to each other.
 *
 * Poses travel as `Float32Array`s of `POSE_FLOATS` numbers a frame: root x y z in metres, then the
 * quaternion x y z w of the 21 joints of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), each relative
 * to its parent, the hips relative to the world. Times are seconds.
 */
import type {
  Analysis,
  CallOptions,
  CurveSubject,
  DatabaseInfo,
  Examples,
  InputInfo,
  Performed,
  Reading,
  StylizeOptions,
} from "../engine/types";

export { StrutError, type StrutErrorCode } from "../engine/errors";
export * from "../engine/types";

/** What is on screen at one instant of live playback. */
export interface LiveFrame {
  /** Styled pose. */
  pose: Float32Array;
  /** Input pose at the same content. */
  inputPose: Float32Array;
  /** Fractional input frame. */
  inputFrame: number;
  /** Seconds of output since the last seek or loop. */
  timeOut: number;
  /** Feet planted by the engine. */
  planted: [left: boolean, right: boolean];
  /** The heaviest classes, heaviest first, at most three. */
  reads: Reading[];
  /** Median cost of a styled frame in the engine, milliseconds. */
  frameMs: number;
  /** Whether the clip began anew since the last frame (loop). */
  looped: boolean;
  /** Whether the end was reached and looping is off. */
  ended: boolean;
}

/** The input frames from `first` to `last`, both of them included. */
export interface FrameRange {
  first: number;
  last: number;
}

/** Where a database comes from. */
export type DatabaseSource = { kind: "demo" } | { kind: "strutdb"; name: string; file: Blob };
/** Where an input comes from. */
export type InputSource = { kind: "built-in"; name: string } | { kind: "bvh"; name: string; bytes: ArrayBuffer };

/**
 * The engine as the page sees it. One database and one input are open at a time; opening another replaces it only if
 * it succeeds. Rejections are `StrutError`s with `code`, `message` (a sentence for people) and `hint`. After a fault
 * the client starts a new worker, opens the same database and input again, applies the same options and then fires
 * `onRestart`.
 */
export interface StrutClient {
  openDatabase(source: DatabaseSource, options?: CallOptions): Promise<DatabaseInfo>;
  /** Names of the built-in inputs, the default first. */
  builtInInputs(): Promise<string[]>;
  openInput(source: InputSource, options?: CallOptions): Promise<InputInfo>;
  /** Takes effect with the next frame. */
  configure(options: StylizeOptions): Promise<void>;
  /** Whether playing begins anew at its end; `range` is the part of the input that is played. */
  setLoop(loop: boolean, range?: FrameRange): Promise<void>;
  /** Advances the output clock by `dtSecs` (≥ 0; 0 repeats the present content in the present style). */
  step(dtSecs: number): Promise<LiveFrame>;
  /** Jumps to an input frame; the engine is warmed up on the frames before it. */
  seek(inputFrame: number): Promise<LiveFrame>;
  /** The whole input in the present options. */
  analyse(options?: CallOptions): Promise<Analysis>;
  /** The examples behind what {@link analyse} gives. */
  examples(subject: CurveSubject, options?: CallOptions): Promise<Examples>;
  /** The whole input in other options, as fast as the engine can; what plays is not touched. */
  style(options: StylizeOptions, call?: CallOptions): Promise<Analysis & { frameMs: number }>;
  /**
   * The input as a style really performs it, as far as that is known: a built-in input, and a package that has the
   * counterparts (`compare/`).
   */
  counterpart(style: string): Promise<Performed | undefined>;
  /** The styled input as BVH text, on the input's own skeleton. */
  exportBvh(options?: CallOptions): Promise<string>;
  onRestart: ((message: string) => void) | undefined;
  dispose(): void;
}
