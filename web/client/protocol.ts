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
import type { Analysis, Note, WasmMemory } from "../engine/types";
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
