/**
 * Types that callers and the worker exchange.
 *
 * Poses travel as `Float32Array`s of `POSE_FLOATS` numbers a frame: root x y z in metres, then the quaternion x y z w
 * of the 21 joints of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), each relative to its parent, the hips
 * relative to the world. Times are seconds.
 */
import type { BuiltInSet } from "../engine/built_in";
import type { Recorded } from "../engine/crowd/limits";
import type { RememberedReadings, Said } from "../engine/file_read";
import type {
  Analysis,
  CallOptions,
  CurveSubject,
  DatabaseInfo,
  Examples,
  InputInfo,
  Note,
  Performed,
  SearchFigures,
  StylizeOptions,
  WasmMemory,
} from "../engine/types";
import type { OpenedAtlas } from "./atlas/opened_atlas";
import type { DriveControl, DriveFrame, DriveInfo, Driven, Root } from "./drive/protocol";
import type { LiveSetup, PerformerStream } from "./live/protocol";
import type { LiveFrame } from "./live_frame";

export { isCancellation, isFault, isUnloaded, StrutError, type StrutErrorCode } from "../engine/errors";
export * from "../engine/types";
export type { BuiltInSet, LiveFrame, RememberedReadings };

/** A recording of a motion, and its duration, seconds. */
export interface RecordedMotion extends Recorded {
  secs: number;
}

/** The input frames from `first` to `last`, inclusive. */
export interface FrameRange {
  /** The first frame. */
  first: number;
  /** The last frame. */
  last: number;
}

/** A whole motion in a style. */
export interface StyledClip extends Analysis {
  /** Mean cost of a frame in the engine, milliseconds. */
  frameMs: number;
  /** The text of a BVH file on the motion's own skeleton; empty unless it was requested. */
  bvh: string;
  /** Possible problems in how the motion was read. */
  notes: readonly Note[];
}

/** Default half-life of a change of style. */
export const STYLE_HALF_LIFE_SECS = 0.1;
/** A weight that the engine eases is set to its target once the difference is smaller than this. */
export const WEIGHT_EPSILON = 1e-3;

/** Maximum number of poses of one `push` of a live stylizer. */
export const MAX_PUSH_FRAMES = 4096;

/** An open object and its memory. */
export interface OpenMemory {
  /** Kind of the object. */
  kind: "database" | "motion" | "session" | "stylizer" | "atlas";
  /**
   * An estimate of its share of {@link MemoryInfo.wasmBytes}, including the bytes of a motion's file: the measured size
   * per frame for this kind, times its frames.
   */
  bytes: number;
}

/** Memory of the engine. */
export interface MemoryInfo extends WasmMemory {
  /** The open objects, in the order of opening. */
  open: OpenMemory[];
}

/** Source of a database. */
export type DatabaseSource = { kind: "demo"; set?: BuiltInSet } | { kind: "strutdb"; name: string; file: Blob };
/** Source of a motion. The bytes of a `Blob` are not copied: it is passed by reference, and the worker reads it. */
export type InputSource =
  | { kind: "built-in"; name: string; set?: BuiltInSet }
  | ({ kind: "bvh"; name: string; bytes: ArrayBuffer | Blob; exact?: ExactPoses } & Said);

/** Size in bytes. */
export function sizeOf(bytes: ArrayBuffer | Blob): number {
  return "size" in bytes ? bytes.size : bytes.byteLength;
}

/** The poses from which a file was written: the file contains them rounded, and without the height of the hips. */
export interface ExactPoses {
  poses: Float32Array;
  /** The body of the poses, and their frames per second; on another body the file is used. */
  proportions: Float32Array;
  rateHz: number;
}

/** A clip of a database, on its body: the text of a BVH file and the poses from which it was written. */
export interface DatabaseClip {
  bvh: string;
  poses: Float32Array;
}

/** The parts of a displayed frame that another session needs to continue from it. */
export type ShownFrame = Pick<LiveFrame, "inputFrame" | "timeOut" | "pose">;

/** Event after a failed worker was replaced. */
export interface Restarted {
  /** The fault, a sentence. */
  why: string;
  /** What could not be reopened, and must be opened by the caller; empty if everything was restored. */
  lost: readonly ("database" | "input")[];
  /** Why it could not be reopened, a sentence; empty if nothing was lost. */
  reason: string;
}

/**
 * A client with one database, one input and one session, as the page needs it; `engine_client.ts` has any number of
 * each. Opening a database or an input replaces the previous one only if it succeeds. An open input is retargeted to a
 * new database. Rejections are `StrutError`s with `code`, `message` (a sentence for the user) and `hint`. After a fault
 * the client starts a new worker, reopens the same database and input with the same options at the same position, and
 * then calls `onRestart`.
 */
export interface StrutClient {
  openDatabase(source: DatabaseSource, options?: CallOptions): Promise<DatabaseInfo>;
  /**
   * Opens a database in a worker of its own while the open one keeps playing, and then replaces it. The input continues
   * from the displayed frame, at its position. Fails as {@link StrutClient.openDatabase} does.
   */
  exchangeDatabase(source: DatabaseSource, options?: CallOptions): Promise<DatabaseInfo>;
  /** Names of the built-in inputs, the default first; those of the open set, if there is one. */
  builtInInputs(): Promise<string[]>;
  /** Indices and names of the neutral clips of the open database. */
  neutralClips(): Promise<{ clip: number; name: string }[]>;
  /** A clip of the open database, by its index. */
  clipOfDatabase(clip: number): Promise<DatabaseClip>;
  openInput(source: InputSource, options?: CallOptions): Promise<InputInfo>;
  /** Takes effect with the next frame. */
  configure(options: StylizeOptions): Promise<void>;
  /** Whether playback loops; `range` is the part of the input that is played. */
  setLoop(loop: boolean, range?: FrameRange): Promise<void>;
  /** Advances the output clock by `dtSecs` (≥ 0; 0 repeats the current content in the current style). */
  step(dtSecs: number): Promise<LiveFrame>;
  /** Jumps to an input frame. The engine is warmed up on the frames before it. */
  seek(inputFrame: number): Promise<LiveFrame>;
  /** Continues from a frame that something else displayed: from the same position and at the same time. */
  continueFrom(shown: ShownFrame): Promise<LiveFrame>;
  /** The whole input with the current options. */
  analyse(options?: CallOptions): Promise<Analysis>;
  /** The examples behind the result of {@link analyse}. */
  examples(subject: CurveSubject, options?: CallOptions): Promise<Examples>;
  /** The whole input with other options, as fast as the engine can. Playback is not affected. */
  style(options: StylizeOptions, call?: CallOptions): Promise<StyledClip>;
  /**
   * The input as performed in a style, if it is known: a built-in input, and a package that has the counterparts
   * (`compare/`).
   */
  counterpart(style: string): Promise<Performed | undefined>;
  /**
   * Compares the search by kd-trees with the exact one over the whole input, for `neighbours` neighbours in every class
   * among `candidates` candidates of its kd-tree. `undefined` from a package without kd-trees (`compare/` has them).
   */
  compareSearch(neighbours: number, candidates: number, options?: CallOptions): Promise<SearchFigures | undefined>;
  /**
   * Opens an atlas: the input on the database as a picture of all distances, with at most `columns` columns. The caller
   * disposes of it.
   */
  openAtlas(columns: number, options?: CallOptions): Promise<OpenedAtlas>;
  /**
   * Records the prediction of the open input, or of a range of it, in every style of the database, within the memory
   * limit: for crowds that perform it (`crowd/`). The styles of the options do not matter.
   * @throws StrutError `bad-input` if it is shorter than half a second
   */
  record(options: StylizeOptions, range: FrameRange | undefined, call?: CallOptions): Promise<RecordedMotion>;
  /** The styled input as BVH text, on the input's own skeleton. */
  exportBvh(options?: CallOptions): Promise<string>;
  /**
   * Starts driving a character with the neutral clips of the database, from a position on, until another input or
   * database is opened or {@link StrutClient.closeDrive} is called. The input stays open.
   * @throws StrutError if the clips for driving cannot be loaded; nothing changes then
   */
  openDrive(root: Root, options?: CallOptions): Promise<DriveInfo>;
  /** Advances the driven character by `dtSecs`; 0 repeats the current instant in the current style. */
  drive(dtSecs: number, control: DriveControl): Promise<DriveFrame>;
  /** The recording of what was driven. */
  driven(): Promise<Driven>;
  /** Restarts at a position, and discards the recording. */
  resetDrive(root: Root): Promise<void>;
  closeDrive(): void;
  /**
   * Starts styling a live performer on the open database, until another input or database is opened, a character is
   * driven, or {@link StrutClient.closeLive} is called. The input stays open. The caller pushes the poses that arrive,
   * and advances the stream.
   */
  openLive(setup: Omit<LiveSetup, "options">, options?: CallOptions): Promise<PerformerStream>;
  closeLive(): void;
  onRestart: ((restarted: Restarted) => void) | undefined;
  dispose(): void;
}
