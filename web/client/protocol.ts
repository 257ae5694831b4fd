/**
 * What callers and the worker exchange.
 *
 * Poses travel as `Float32Array`s of `POSE_FLOATS` numbers a frame: root x y z in metres, then the
 * quaternion x y z w of the 21 joints of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), each relative
 * to its parent, the hips relative to the world. Times are seconds.
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

/** What an engine recorded of a motion, and how long that is, seconds. */
export interface RecordedMotion extends Recorded {
  secs: number;
}

/** The input frames from `first` to `last`, both of them included. */
export interface FrameRange {
  /** The first frame. */
  first: number;
  /** The last frame. */
  last: number;
}

/** A motion in a style, as a whole. */
export interface StyledClip extends Analysis {
  /** Mean cost of a frame in the engine, milliseconds. */
  frameMs: number;
  /** The text of a BVH file on the motion's own skeleton; empty unless it was asked for. */
  bvh: string;
  /** What may be wrong in how the motion was read. */
  notes: readonly Note[];
}

/** Default half-life of a change of style. */
export const STYLE_HALF_LIFE_SECS = 0.1;
/** A weight that the engine eases is set to its target once it is nearer than this. */
export const WEIGHT_EPSILON = 1e-3;

/** Maximum number of poses of one `push` of a live stylizer. */
export const MAX_PUSH_FRAMES = 4096;

/** Something open, and what it takes. */
export interface OpenMemory {
  /** What it is. */
  kind: "database" | "motion" | "session" | "stylizer" | "atlas";
  /**
   * An estimate of its share of {@link MemoryInfo.wasmBytes}, with the bytes of a motion's file: what things of this kind
   * were measured to take a frame, times its frames.
   */
  bytes: number;
}

/** What the engine holds. */
export interface MemoryInfo extends WasmMemory {
  /** What is open, in the order of opening. */
  open: OpenMemory[];
}

/** Where a database comes from. */
export type DatabaseSource = { kind: "demo"; set?: BuiltInSet } | { kind: "strutdb"; name: string; file: Blob };
/** Where a motion comes from. The bytes of a `Blob` are not copied: it is passed by reference, and the worker reads it. */
export type InputSource =
  | { kind: "built-in"; name: string; set?: BuiltInSet }
  | ({ kind: "bvh"; name: string; bytes: ArrayBuffer | Blob; exact?: ExactPoses } & Said);

/** Size in bytes. */
export function sizeOf(bytes: ArrayBuffer | Blob): number {
  return "size" in bytes ? bytes.size : bytes.byteLength;
}

/** The poses that a file was written from: it holds them rounded, and not the height of the hips. */
export interface ExactPoses {
  poses: Float32Array;
  /** Of the body that they are of, and frames a second: on another one the file counts. */
  proportions: Float32Array;
  rateHz: number;
}

/** A clip of a database, on its body: the text of a BVH file and what that was written from. */
export interface DatabaseClip {
  bvh: string;
  poses: Float32Array;
}

/** A shown frame, as far as another session must know it to go on from there. */
export type ShownFrame = Pick<LiveFrame, "inputFrame" | "timeOut" | "pose">;

/** Event after a failed worker was replaced. */
export interface Restarted {
  /** The fault, a sentence. */
  why: string;
  /** What could not be opened again, and must be opened by the caller; empty if all is as it was. */
  lost: readonly ("database" | "input")[];
  /** Why it could not, a sentence; empty if nothing was lost. */
  reason: string;
}

/**
 * A client with one database, one input and one session, as the page needs it; `engine_client.ts` has any number of each.
 * Opening a database or an input replaces the one before only if it succeeds; an open input is carried over to a new database.
 * Rejections are `StrutError`s with `code`, `message` (a sentence for people) and `hint`. After a fault the client starts a
 * new worker, reopens the same database and input with the same options at the same place, and then calls `onRestart`.
 */
export interface StrutClient {
  openDatabase(source: DatabaseSource, options?: CallOptions): Promise<DatabaseInfo>;
  /**
   * Opens a database in a worker of its own, while the open one plays on, and then puts it in the place of that one: the input
   * is played on from the shown frame, where it is shown. Fails as {@link StrutClient.openDatabase} does.
   */
  exchangeDatabase(source: DatabaseSource, options?: CallOptions): Promise<DatabaseInfo>;
  /** Names of the built-in inputs, the default first; those of the set that is open, if one is. */
  builtInInputs(): Promise<string[]>;
  /** The neutral clips of the database that is open: their numbers and names. */
  neutralClips(): Promise<{ clip: number; name: string }[]>;
  /** A clip of the database that is open, by its number. */
  clipOfDatabase(clip: number): Promise<DatabaseClip>;
  openInput(source: InputSource, options?: CallOptions): Promise<InputInfo>;
  /** Takes effect with the next frame. */
  configure(options: StylizeOptions): Promise<void>;
  /** Whether playback loops; `range` is the part of the input that is played. */
  setLoop(loop: boolean, range?: FrameRange): Promise<void>;
  /** Advances the output clock by `dtSecs` (≥ 0; 0 repeats the present content in the present style). */
  step(dtSecs: number): Promise<LiveFrame>;
  /** Jumps to an input frame; the engine is warmed up on the frames before it. */
  seek(inputFrame: number): Promise<LiveFrame>;
  /** Goes on from a frame as something else showed it: from the same place and at the same time. */
  continueFrom(shown: ShownFrame): Promise<LiveFrame>;
  /** The whole input in the present options. */
  analyse(options?: CallOptions): Promise<Analysis>;
  /** The examples behind what {@link analyse} gives. */
  examples(subject: CurveSubject, options?: CallOptions): Promise<Examples>;
  /** The whole input in other options, as fast as the engine can; what plays is not touched. */
  style(options: StylizeOptions, call?: CallOptions): Promise<StyledClip>;
  /**
   * The input as a style really performs it, as far as that is known: a built-in input, and a package that has the
   * counterparts (`compare/`).
   */
  counterpart(style: string): Promise<Performed | undefined>;
  /**
   * The search for so many neighbours of every class among so many candidates of its kd-tree, beside the exact one, over the
   * whole input; `undefined` from a package without kd-trees (`compare/` has them).
   */
  compareSearch(neighbours: number, candidates: number, options?: CallOptions): Promise<SearchFigures | undefined>;
  /** The input on the database as a picture of every distance, with so many columns at most; the caller disposes of it. */
  openAtlas(columns: number, options?: CallOptions): Promise<OpenedAtlas>;
  /**
   * What is predicted of the open input, or of a range of it, in every style of the database, as far as there is room for it:
   * for those who perform it (`crowd/`). The styles of the options do not matter.
   * @throws StrutError `bad-input` if it is shorter than half a second
   */
  record(options: StylizeOptions, range: FrameRange | undefined, call?: CallOptions): Promise<RecordedMotion>;
  /** The styled input as BVH text, on the input's own skeleton. */
  exportBvh(options?: CallOptions): Promise<string>;
  /**
   * Has a character be steered over the neutral clips of the database, from a place on, until another input or database is
   * opened or {@link StrutClient.closeDrive}; the open input stays open beside it.
   * @throws StrutError if what is driven with cannot be loaded; nothing changes then
   */
  openDrive(root: Root, options?: CallOptions): Promise<DriveInfo>;
  /** Advances the driven character by `dtSecs`; 0 repeats the present instant in the present style. */
  drive(dtSecs: number, control: DriveControl): Promise<DriveFrame>;
  /** What was driven. */
  driven(): Promise<Driven>;
  /** Begins anew at a place, and forgets what was driven. */
  resetDrive(root: Root): Promise<void>;
  closeDrive(): void;
  /**
   * Has a performer be styled on the open database, until another input or database is opened, a character is steered, or
   * {@link StrutClient.closeLive}; the open input stays open beside it. The caller pushes what arrives, and goes on.
   */
  openLive(setup: Omit<LiveSetup, "options">, options?: CallOptions): Promise<PerformerStream>;
  closeLive(): void;
  onRestart: ((restarted: Restarted) => void) | undefined;
  dispose(): void;
}
