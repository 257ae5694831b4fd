/**
 * The public API of the package `strut-motion`.
 *
 * Metres, seconds, radians; +Y up, right-handed, facing +Z. A pose is `POSE_FLOATS` = 87 numbers: root x y z, then the
 * quaternions x y z w of the 21 joints of the canonical humanoid, each relative to its parent, the hips relative to the
 * world.
 */
import type { ClientSession, StyleChange } from "../client/handles";
import type { KeyStyleModel } from "../client/models/key_style";
import type { WalkModel } from "../client/models/walk";
import type {
  CallOptions,
  DatabaseInfo,
  FileRead,
  FileReading,
  MemoryInfo,
  Note,
  Styled,
  StyleWeights,
  StylizeOptions,
} from "../client/protocol";
import type { Analysis, ModelOptions } from "../engine/types";
import type { ClipOptions, RigNode, ThreeLike } from "../formats/animation_clip";
import type { TraceFrame } from "../formats/trace";
import type { Live, LiveOptions } from "../streams/live";
import type { PoseSource } from "../streams/pose_source";

/** Source of a file: a URL, the name of a built-in object ("strut:…"), its text or bytes, or the file itself. */
export type Source = string | URL | ArrayBuffer | Uint8Array<ArrayBuffer> | Blob;

/** Options of styling; missing ones have the engine's default. */
export type Options = Partial<StylizeOptions>;

/** Options of opening a motion. */
export interface MotionOptions {
  /** Properties that the caller specifies for a file, overriding what is detected from the body. */
  reading?: FileReading | undefined;
}

/** Options of loading the package. */
export interface LoadOptions {
  /** Location of the package's files: the URL of their folder, or a function from a file's name to its URL. */
  assets?: string | ((file: string) => string);
  /** Whether the engine may have a worker of its own; otherwise it runs on the calling thread. */
  worker?: boolean;
  /** Aborts loading. */
  signal?: AbortSignal;
}

/** Where the engine runs: in a worker, in a worker started from a blob, on the page's thread, or on Node's. */
export type Thread = "worker" | "blob" | "page" | "node";

/** The engine. The caller owns everything that it opens, and disposes of it. */
export interface Strut {
  /** Version of the package. */
  readonly version: string;
  /** Where the engine runs. */
  readonly thread: Thread;
  /** Called after a fault, with a sentence: a new engine has replaced the failed one, and everything is open again. */
  onrestart: ((message: string) => void) | undefined;

  /**
   * Opens a database: a `.strutdb` file, `"strut:walk"` (walks in eight styles) or `"strut:built-in"` (all built-in
   * motions). From BVH files, or a zip of them, whose names contain action and style (`walk_old_1.bvh`), a database is
   * built.
   * @throws StrutError `bad-file`, `bad-input`, `load` or `cancelled`
   */
  openDatabase(source: Source | readonly File[], call?: CallOptions): Promise<Database>;

  /**
   * Opens a motion: a BVH file or its text, or a built-in one such as `"strut:neutral-walk"`.
   * @param options also `reading`: properties that the caller specifies for the file, overriding what is detected from
   * the body
   * @throws StrutError `bad-file`, `bad-input`, `load` or `cancelled`
   */
  openMotion(source: Source, options?: MotionOptions & CallOptions): Promise<Motion>;

  /**
   * Styles a whole motion.
   * @param options also `bvh`: whether {@link StyledMotion.toBVH} will be needed, `true` by default
   * @throws StrutError `bad-input` for an unknown or impossible option
   */
  stylize(
    motion: Motion,
    database: Database,
    options?: Options & CallOptions & { bvh?: boolean },
  ): Promise<StyledMotion>;

  /** Styles poses as they arrive. @throws StrutError `bad-input` or `cancelled` */
  createStylizer(database: Database, options?: Options & Pick<CallOptions, "signal">): Promise<LiveStylizer>;

  /**
   * Styles a live performer as poses arrive; `strut-motion/streams` has sources.
   * @throws StrutError `bad-input` for an unknown or impossible option, `load` or `cancelled`
   */
  live(database: Database, source: PoseSource, options?: LiveOptions & Pick<CallOptions, "signal">): Promise<Live>;

  /** Plays a motion in real time. @throws StrutError `bad-input` or `cancelled` */
  createPlayback(
    motion: Motion,
    database: Database,
    options?: Options & Pick<CallOptions, "signal">,
  ): Promise<Playback>;

  /**
   * A new database: `database` with a motion from a BVH file as an additional style.
   * @throws StrutError `bad-input` or `bad-file`
   */
  addStyle(database: Database, motion: Motion, style: string, call?: CallOptions): Promise<Database>;

  /**
   * Opens a walk model: a `.strutwalk` file, or trained on an open or a built-in database. It runs on the calling
   * thread.
   * @throws StrutError `bad-file`, `load` or `cancelled`
   */
  openWalk(source: Source | Database, call?: CallOptions): Promise<WalkModel>;

  /**
   * Opens a key-style model: a `.strutkeys` file, or trained on an open or a built-in database. It runs on the calling
   * thread.
   * @param options also `axes`: the style variables for which it is trained, names of measures or expressions
   * @throws StrutError `bad-file`, `bad-input`, `load` or `cancelled`
   */
  openKeyStyle(source: Source | Database, options?: { axes?: readonly string[] } & CallOptions): Promise<KeyStyleModel>;

  /**
   * The memory of the engine, with estimates for the open objects. It grows, and only {@link dispose} releases it. The
   * memory of disposed objects is reused for those opened next.
   */
  memory(): Promise<MemoryInfo>;

  /** Closes everything and ends the engine; only this releases WebAssembly's memory. */
  dispose(): void;
}

/** An open database. */
export interface Database {
  /** Its properties. */
  readonly info: DatabaseInfo;
  /** The `.strutdb` file. @throws StrutError `bad-input` for built-in databases, which cannot be saved as a file */
  toFile(): Promise<Blob>;
  /** Closes it. */
  dispose(): void;
}

/** An open motion, which can be used with any database. */
export interface Motion {
  /** Name of the file without its extension, or of the built-in motion. */
  readonly name: string;
  /** Frames of the file. */
  readonly frames: number;
  /** Frames per second of the file. */
  readonly rateHz: number;
  /** Length, seconds. */
  readonly durationSecs: number;
  /** A sentence for the user about the joint mapping; empty if there is nothing to report. */
  readonly note: string;
  /** Possible problems in how the file was read; empty if there are none. */
  readonly notes: readonly Note[];
  /** How the file was read; `undefined` for a built-in motion. */
  readonly reading: FileRead | undefined;
  /** The motion on the body and at the frame rate of a database: 87 numbers per frame. */
  poses(database: Database, call?: CallOptions): Promise<Float32Array>;
  /** Closes it. */
  dispose(): void;
}

/** A motion in a style. Poses and times are those of {@link Analysis}: one per input frame, at the database's frame rate. */
export interface StyledMotion extends Analysis {
  /** Name of the input. */
  readonly name: string;
  /** The body on which the poses are defined: 21 × xyz offsets, metres. */
  readonly proportions: Float32Array;
  /** Input frames per second. */
  readonly rateHz: number;
  /** Possible problems in how the motion was read, including those found on the database: cuts and repaired frames. */
  readonly notes: readonly Note[];
  /** The engine's data for every frame. */
  readonly trace: TraceFrame[];
  /** The text of a BVH file on the motion's own skeleton. @throws StrutError `bad-input` after `bvh: false` */
  toBVH(): string;
  /** The mannequin with the motion as binary glTF 2.0. */
  toGLB(): Uint8Array<ArrayBuffer>;
  /** The motion as VRM Animation 1.0, which plays on every VRM. */
  toVRMA(): Uint8Array<ArrayBuffer>;
  /**
   * The motion as an `AnimationClip` of the caller's three.js: one key per frame at {@link Analysis.timeOut}.
   * @param root the mannequin of {@link toGLB} as loaded by three.js, or another rig with the same joints
   * @throws StrutError `bad-input` if the rig lacks a joint
   */
  toAnimationClip<Clip, Track>(three: ThreeLike<Clip, Track>, root: RigNode, options?: ClipOptions): Clip;
}

/** Styles poses as they arrive. */
export interface LiveStylizer {
  /** Number of frames by which the output lags behind the input. */
  readonly latencyFrames: number;
  /** Takes effect with the next {@link push}. @throws StrutError `bad-input`, at once */
  setStyles(styles: StyleWeights, change?: StyleChange): void;
  /** Takes effect with the next {@link push}. @throws StrutError `bad-input`, at once */
  configure(options: Partial<ModelOptions>): void;
  /**
   * Styles the next poses, 1/`info.rateHz` apart, on the body of the database.
   * @param poses a whole number of poses, at most 4,096; copied
   */
  push(poses: Float32Array): Promise<Styled>;
  /** Restarts at the next pose, as after a cut. */
  reset(): void;
  /** Closes it. */
  dispose(): void;
}

/** A motion that plays in real time. */
export interface Playback extends Pick<ClientSession, "step" | "seek" | "setLoop" | "analyse" | "dispose"> {
  /**
   * Changes some of the options; a change of the styles fades in from the next frame on.
   * @throws StrutError `bad-input`, at once; nothing changes then
   */
  configure(change: Options): Promise<void>;
}
