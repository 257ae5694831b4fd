/**
 * What the package `strut-motion` gives to its users.
 *
 * Metres, seconds, radians; +Y up, right-handed, facing +Z. A pose is `POSE_FLOATS` = 87 numbers. They are root x y z, then the
 * quaternions x y z w of the 21 joints of the canonical humanoid. Each is relative to its parent, that of the hips to the world.
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

/** Where a file comes from: a URL, the name of something built in ("strut:…"), its text or bytes, or the file itself. */
export type Source = string | URL | ArrayBuffer | Uint8Array<ArrayBuffer> | Blob;

/** Options of styling; what is not given is the engine's default. */
export type Options = Partial<StylizeOptions>;

/** How a motion is opened. */
export interface MotionOptions {
  /** What is said of a file in place of what is read from the body. */
  reading?: FileReading | undefined;
}

/** How the package is loaded. */
export interface LoadOptions {
  /** Where the package's files lie: the URL of their folder, or a function from a file's name to its URL. */
  assets?: string | ((file: string) => string);
  /** Whether the engine may have a worker of its own; otherwise it works on the calling thread. */
  worker?: boolean;
  /** Aborts loading. */
  signal?: AbortSignal;
}

/** Where the engine runs: in a worker, in a worker started from a blob, on the page's thread, or on Node's. */
export type Thread = "worker" | "blob" | "page" | "node";

/** The engine. Everything that it opens belongs to the caller, who disposes of it. */
export interface Strut {
  /** Version of the package. */
  readonly version: string;
  /** Where the engine runs. */
  readonly thread: Thread;
  /** Is called after a fault, with a sentence: another engine has taken the place, and all that was open is open again. */
  onrestart: ((message: string) => void) | undefined;

  /**
   * Opens a database: a `.strutdb` file, `"strut:walk"` (walks in eight styles) or `"strut:built-in"` (all built-in motions).
   * Of BVH files, or a zip of them, whose names say action and style (`walk_old_1.bvh`), one is built.
   * @throws StrutError `bad-file`, `bad-input`, `load` or `cancelled`
   */
  openDatabase(source: Source | readonly File[], call?: CallOptions): Promise<Database>;

  /**
   * Opens a motion: a BVH file or its text, or a built-in one such as `"strut:neutral-walk"`.
   * @param options also `reading`: what is said of the file in place of what is read from the body
   * @throws StrutError `bad-file`, `bad-input`, `load` or `cancelled`
   */
  openMotion(source: Source, options?: MotionOptions & CallOptions): Promise<Motion>;

  /**
   * Styles a whole motion.
   * @param options also `bvh`: whether {@link StyledMotion.toBVH} will be wanted, `true` unless it is given
   * @throws StrutError `bad-input` for an unknown or impossible option
   */
  stylize(
    motion: Motion,
    database: Database,
    options?: Options & CallOptions & { bvh?: boolean },
  ): Promise<StyledMotion>;

  /** Styles poses as they arrive. @throws StrutError `bad-input` */
  createStylizer(database: Database, options?: Options): Promise<LiveStylizer>;

  /**
   * Styles a performer as poses arrive; `strut-motion/streams` has sources.
   * @throws StrutError `bad-input` for an unknown or impossible option, `load`
   */
  live(database: Database, source: PoseSource, options?: LiveOptions): Promise<Live>;

  /** Plays a motion in real time. @throws StrutError `bad-input` */
  createPlayback(motion: Motion, database: Database, options?: Options): Promise<Playback>;

  /** A new database: one with a motion, a BVH file, as one more style. @throws StrutError `bad-input` or `bad-file` */
  addStyle(database: Database, motion: Motion, style: string, call?: CallOptions): Promise<Database>;

  /**
   * Opens a model of walks: a `.strutwalk` file, or trained on an open or a built-in database. It is on the calling thread.
   * @throws StrutError `bad-file`, `load` or `cancelled`
   */
  openWalk(source: Source | Database, call?: CallOptions): Promise<WalkModel>;

  /**
   * Opens a key-style model: a `.strutkeys` file, or trained on an open or a built-in database. It is on the calling thread.
   * @param options also `axes`: the style variables that it is trained for, names of measures or expressions
   * @throws StrutError `bad-file`, `bad-input`, `load` or `cancelled`
   */
  openKeyStyle(source: Source | Database, options?: { axes?: readonly string[] } & CallOptions): Promise<KeyStyleModel>;

  /**
   * How much memory the engine holds, and estimates of what is open. The memory grows, and only {@link dispose} gives it back.
   * What is disposed of leaves its place to what is opened next.
   */
  memory(): Promise<MemoryInfo>;

  /** Closes everything and ends the engine: only this gives the memory of WebAssembly back. */
  dispose(): void;
}

/** An open database. */
export interface Database {
  /** What it holds. */
  readonly info: DatabaseInfo;
  /** The `.strutdb` file. @throws StrutError `bad-input` for the built-in motions, which cannot be saved as a file */
  toFile(): Promise<Blob>;
  /** Closes it. */
  dispose(): void;
}

/** An open motion, which can be used with any database. */
export interface Motion {
  /** Name of the file without its ending, or of the built-in motion. */
  readonly name: string;
  /** Frames of the file. */
  readonly frames: number;
  /** Frames a second of the file. */
  readonly rateHz: number;
  /** Length, seconds. */
  readonly durationSecs: number;
  /** A sentence for people about the match of the skeletons; empty if there is nothing to say. */
  readonly note: string;
  /** What may be wrong in how the file was read; empty for a clean one. */
  readonly notes: readonly Note[];
  /** How the file was read; `undefined` for a built-in motion. */
  readonly reading: FileRead | undefined;
  /** The motion on the body and at the rate of a database: 87 numbers a frame. */
  poses(database: Database, call?: CallOptions): Promise<Float32Array>;
  /** Closes it. */
  dispose(): void;
}

/** A motion in a style. Poses and times are those of {@link Analysis}: one an input frame, at the database's rate. */
export interface StyledMotion extends Analysis {
  /** Name of the input. */
  readonly name: string;
  /** The body that the poses are on: 21 × xyz offsets, metres. */
  readonly proportions: Float32Array;
  /** Input frames a second. */
  readonly rateHz: number;
  /** What may be wrong in how the motion was read, with what only shows on the database: cuts and repaired frames. */
  readonly notes: readonly Note[];
  /** What the engine did in every frame. */
  readonly trace: TraceFrame[];
  /** The text of a BVH file on the motion's own skeleton. @throws StrutError `bad-input` after `bvh: false` */
  toBVH(): string;
  /** The mannequin with the motion as binary glTF 2.0. */
  toGLB(): Uint8Array<ArrayBuffer>;
  /** The motion as VRM Animation 1.0, which plays on every VRM. */
  toVRMA(): Uint8Array<ArrayBuffer>;
  /**
   * The motion as an `AnimationClip` of the caller's three.js: a key a frame at {@link Analysis.timeOut}.
   * @param root the mannequin of {@link toGLB} as three.js loaded it, or another rig of the same joints
   * @throws StrutError `bad-input` if the rig lacks a joint
   */
  toAnimationClip<Clip, Track>(three: ThreeLike<Clip, Track>, root: RigNode, options?: ClipOptions): Clip;
}

/** Poses that are styled as they arrive. */
export interface LiveStylizer {
  /** Frames by which the output lags behind the input. */
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
   * @throws StrutError `bad-input`, at once, and nothing is changed
   */
  configure(change: Options): Promise<void>;
}
