/**
 * What goes in and out of the engine.
 *
 * Poses are `Float32Array`s of {@link POSE_FLOATS} numbers a frame: root x y z in metres, then the quaternion x y z w
 * of the 21 joints of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), each relative to its parent, the
 * hips relative to the world. Times are seconds.
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
