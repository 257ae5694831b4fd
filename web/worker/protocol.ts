/**
 * What the page and the worker say to each other.
 *
 * Poses travel as `Float32Array`s of {@link POSE_FLOATS} numbers a frame: root x y z in metres, then the
 * quaternion x y z w of the 21 joints of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), each relative
 * to its parent, the hips relative to the world. Times are seconds.
 */

/** Joints of the canonical humanoid. */
export const JOINTS = 21;
/** Numbers of one pose in a flat array. */
export const POSE_FLOATS = 3 + 4 * JOINTS;

/** A database that is open in the worker. */
export interface DatabaseInfo {
  name: string;
  frames: number;
  rateHz: number;
  actions: string[];
  styles: string[];
  neutral: string;
  /** Offset of each joint from its parent in the T-pose, metres: 21 × xyz; the first is the height of the hips. */
  proportions: Float32Array;
  classes: { action: string; style: string; frames: number }[];
}

/** A motion that is open as the input. */
export interface InputInfo {
  name: string;
  source: "built-in" | "bvh";
  /** Frames at the database's rate. */
  frames: number;
  rateHz: number;
  durationSecs: number;
  /** A sentence for people about the match of the skeletons; empty if there is nothing to say. */
  note: string;
  /** The input on the database's humanoid, `frames` poses. */
  poses: Float32Array;
  /** Foot contacts of the input, left and right interleaved, 1 while planted. */
  contacts: Uint8Array;
}

/** Everything that changes the output; the defaults are the engine's. */
export interface StylizeOptions {
  /** Weight of each style by name; the remainder to 1 belongs to the neutral style. */
  styles: Record<string, number>;
  /** Neighbours in each class. */
  k: number;
  /** Ridge regularisation, in units of K. */
  lambda: number;
  /** Share of the bias that is given back, 0–1. */
  rho: number;
  /** Deviations beyond which the input is taken as bias. */
  kappa: number;
  /** Sharpness of the mixture. */
  delta: number;
  /** Whether the output has its own timing. */
  timing: boolean;
  /** Whether planted feet are held. */
  footplant: boolean;
}

/** One class of the database and how much the engine reads the input as it. */
export interface Reading {
  action: string;
  style: string;
  weight: number;
}

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

/** The whole input in the present style: what the timeline draws and what is exported. */
export interface Analysis {
  /** Styled poses, one an input frame. */
  poses: Float32Array;
  /** Output time of each input frame. */
  timeOut: Float32Array;
  /** Planted feet of the output, left and right interleaved, one pair an input frame. */
  planted: Uint8Array;
  durationOutSecs: number;
}

/** Progress of something long. */
export interface Progress {
  /** What is being done, for people. */
  label: string;
  /** 0–1. */
  fraction: number;
}

/** Options of every call that may take long. */
export interface CallOptions {
  signal?: AbortSignal;
  onProgress?: (progress: Progress) => void;
}

/** Where a database comes from. */
export type DatabaseSource = { kind: "demo" } | { kind: "strutdb"; name: string; bytes: ArrayBuffer };
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
  setLoop(loop: boolean): Promise<void>;
  /** Advances the output clock by `dtSecs` (≥ 0; 0 repeats the present content in the present style). */
  step(dtSecs: number): Promise<LiveFrame>;
  /** Jumps to an input frame; the engine is warmed up on the frames before it. */
  seek(inputFrame: number): Promise<LiveFrame>;
  analyse(options?: CallOptions): Promise<Analysis>;
  /** The styled input as BVH text, on the input's own skeleton. */
  exportBvh(options?: CallOptions): Promise<string>;
  onRestart: ((message: string) => void) | undefined;
  dispose(): void;
}
