/**
 * What goes in and out of the engine.
 *
 * Poses are `Float32Array`s of `POSE_FLOATS` numbers a frame: root x y z in metres, then the quaternion x y z w
 * of the 21 joints of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), each relative to its parent, the
 * hips relative to the world. Times are seconds.
 */

import type { Role } from "../humanoid";

/** A database that is open in the worker. */
export interface DatabaseInfo {
  /** Name of the file without its ending, or of the built-in database. */
  name: string;
  /** Frames of all clips. */
  frames: number;
  /** Frames a second of every clip. */
  rateHz: number;
  /** Names of the actions. */
  actions: string[];
  /** Names of the styles. */
  styles: string[];
  /** Name of the neutral style. */
  neutral: string;
  /** Offset of each joint from its parent in the T-pose, metres: 21 × xyz; the first is the height of the hips. */
  proportions: Float32Array;
  /** Every pair of an action and a style that has clips. */
  classes: { action: string; style: string; frames: number }[];
}

/** An axis of a file that points up. */
export const UP_AXES = ["y", "-y", "z", "-z", "x", "-x"] as const;
/** An axis of a file that points up. */
export type UpAxis = (typeof UP_AXES)[number];

/** Joints by role, by their names; `null` says that the skeleton has no such joint. */
export type JointNames = Readonly<Partial<Record<Role, string | null>>>;

/** What a person says of a file, in place of what is read from the body. What is left out is read. */
export interface FileReading {
  /** The file's up axis. */
  up?: UpAxis;
  /** Height of the floor along the up axis, metres. */
  floor?: number;
  /** Whether left and right are the other way round than they are read. */
  swapSides?: boolean;
  /** Whether the file is a mirror image, whatever the body shows; `swapSides` does not count then. */
  mirrored?: boolean;
  /** Metres per unit of length. */
  unit?: number;
  /** The joint of each role; those of roles that are left out are found. */
  joints?: JointNames;
}

/** What may be wrong in how a motion was read. */
export interface Note {
  /** What it is about; docs/reading.md lists the codes. */
  code: string;
  /** The sentence. */
  text: string;
}

/** How a file was read, and where each part of that comes from. */
export interface FileRead {
  /** Frames of the file. */
  frames: number;
  /** Frames a second of the file. */
  rateHz: number;
  /** The file's up axis. */
  up: UpAxis;
  /** Whether +Y was taken as it is, the axis was guessed from the body, or a person said it. */
  upFrom: "as-is" | "guessed" | "said";
  /** Whether left and right are exchanged: the file is a mirror image. */
  mirrored: boolean;
  /** Whether the sides are as they are named, were guessed from the body, or a person said them. */
  sidesFrom: "as-is" | "guessed" | "said";
  /** Height of the floor along the up axis, metres. */
  floorMetres: number;
  /** Whether the floor was measured, or a person said it. */
  floorFrom: "measured" | "said";
  /** Metres per unit of length. */
  metresPerUnit: number;
  /** Whether the unit was measured on the body, or a person said it. */
  unitFrom: "measured" | "said";
  /** Height of the body, metres. */
  heightMetres: number;
  /** The joint of each role. */
  joints: Readonly<Record<Role, string | null>>;
  /** Whether all joints were found by their names, some by the shape of the skeleton, or a person said some. */
  jointsFrom: "names" | "shape" | "said";
  /** The skeleton: its identity, which is the same for the same names in the same tree, and the names of its joints. */
  skeleton: { id: string; joints: readonly string[] };
  /** What was guessed and can be said instead. */
  guesses: readonly ("up" | "sides" | "joints")[];
  /** What a person said. */
  said: FileReading;
  /** Whether that was remembered of an earlier file with the skeleton. */
  remembered: boolean;
}

/** What a motion's file says, before it is carried over to a database. */
export interface MotionFacts {
  /** Frames of the file. */
  frames: number;
  /** Frames a second of the file. */
  rateHz: number;
  /** Length, seconds. */
  durationSecs: number;
  /** A sentence for people about the match of the skeletons; empty if there is nothing to say. */
  note: string;
  /** What may be wrong in how the file was read. */
  notes: readonly Note[];
  /** How the file was read; `undefined` for a motion that came from none. */
  reading: FileRead | undefined;
}

/** What the engine holds. */
export interface WasmMemory {
  /** Size of its linear memory, bytes: it grows with what is open and never shrinks. */
  wasmBytes: number;
}

/** A motion that is open as the input. */
export interface InputInfo {
  name: string;
  source: "built-in" | "bvh";
  /** Frames at the database's rate. */
  frames: number;
  rateHz: number;
  durationSecs: number;
  /** Sentences for people on what may be wrong and on the match of the skeletons; empty if there is nothing to say. */
  note: string;
  /** What may be wrong in how it was read. */
  notes: readonly Note[];
  /** How its file was read; `undefined` for a motion that came from none. */
  reading: FileRead | undefined;
  /** The input on the database's humanoid, `frames` poses. */
  poses: Float32Array;
  /** Foot contacts of the input, left and right interleaved, 1 while planted. */
  contacts: Uint8Array;
}

/** Parts of the body that may take styles of their own, in the engine's order (`transfer/body_part.rs`). */
export const BODY_PARTS = ["head", "torso", "left_arm", "right_arm", "legs"] as const;
/** A part of the body. */
export type BodyPart = (typeof BODY_PARTS)[number];

/** How the neighbours become a prediction (`transfer/options.rs`): the mixture of autoregressive models is the product. */
export const METHODS = ["mar", "lar", "knn", "nn"] as const;
export type Method = (typeof METHODS)[number];

/** What Strut is compared with and is trained beforehand (`baselines/`): only the Compare view's package has it. */
export const TRAINED_METHODS = ["gar", "lti", "gp"] as const;
export type TrainedMethod = (typeof TRAINED_METHODS)[number];

/** Weight of each style by name; the remainder to 1 belongs to the neutral style. */
export type StyleWeights = Readonly<Record<string, number>>;

/** The styles that a style track has reached at an input frame. */
export interface StyleKey {
  /** Input frame. */
  frame: number;
  /** Styles of the whole body. */
  styles: StyleWeights;
}

/** Everything that changes the output; the defaults are the engine's. */
export interface StylizeOptions {
  /** Styles of the whole body. */
  styles: StyleWeights;
  /** Styles of the parts of the body that have their own. */
  parts: Readonly<Partial<Record<BodyPart, StyleWeights>>>;
  /** Styles of the whole body over time, in the order of frames; without keys they are {@link styles} throughout. */
  track: readonly StyleKey[];
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
  /** η: how much of the tempo of a walk or a run becomes the style's own; 0 keeps the input's, 1 forgets it. */
  tempo: number;
  /** Whether temporal coherence suppresses jitter where the input is far from the database; method `mar` only. */
  coherence: boolean;
  /** Whether the output has its own timing. */
  timing: boolean;
  /** Whether planted feet are held. */
  footplant: boolean;
  /** How neighbours become a prediction. */
  method: Method | TrainedMethod;
  /** The action that the input is known to be; empty where the engine is to read it. */
  action: string;
  /** The style that the input is known to have; empty where the engine is to read it. */
  inputStyle: string;
}

/** Options without the styles. */
export type ModelOptions = Omit<StylizeOptions, "styles" | "parts" | "track">;

/** The engine's defaults (`rust/strut-core/src/transfer/options.rs` says why), in the neutral style. */
export const DEFAULT_OPTIONS: Readonly<StylizeOptions> = {
  styles: {},
  parts: {},
  track: [],
  k: 40,
  lambda: 0.1,
  rho: 0.7,
  kappa: 3,
  delta: 0.35,
  tempo: 0.5,
  coherence: true,
  timing: true,
  footplant: true,
  method: "mar",
  action: "",
  inputStyle: "",
};

/** One class of the database and how much the engine reads the input as it. */
export interface Reading {
  /** Its action. */
  action: string;
  /** Its style. */
  style: string;
  /** How much of the prediction comes from it, 0–1. */
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
  /** Weight of each class of the database in each frame. */
  classWeights: Float32Array;
  /** Length of the output, seconds. */
  durationOutSecs: number;
  /** What may be wrong with it, beside the notes on the input. */
  notes: readonly Note[];
  /** Mean distance of the input's frames from the nearest ones of the database, metres; `undefined` for a built-in input. */
  distanceMetres: number | undefined;
}

/** A batch of styled frames, one an input frame. */
export interface Styled {
  /** Poses. */
  poses: Float32Array;
  /** Seconds since the frame before; 0 for the first after a reset. */
  durations: Float32Array;
  /** Feet held in place, left and right interleaved. */
  planted: Uint8Array;
  /** Weight of each class of the database in the last frame. */
  classWeights: Float32Array;
}

/** A motion that was performed in a style instead of styled: frame for frame with its input. */
export type Performed = Pick<Analysis, "poses" | "timeOut" | "planted">;

/** A search by kd-trees beside the exact one, over a whole motion. */
export interface SearchFigures {
  /** Share of the nearest windows of every class that kd-trees find, 0–1. */
  recall: number;
  /** Median time of a frame's exact search in all classes, milliseconds. */
  exactMs: number;
  /** The same by kd-trees. */
  treesMs: number;
}

/** What a curve may show of a pose: the rotation of a joint, by its number, or the height of the hips. */
export type CurveSubject = number | "height";

/** The examples of the database that each frame of a clip was predicted from, in the styles asked for. */
export interface Examples {
  subject: CurveSubject;
  /** How many there are of each frame, the nearest first. */
  counts: Uint16Array;
  /** How much each counted, 0–1, frame after frame. */
  weights: Float32Array;
  /** The quaternion x y z w of the joint in each, or the height of the hips in metres. */
  values: Float32Array;
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
  /** Cancels the call, which rejects with `cancelled` then. */
  signal?: AbortSignal;
  /** Is told how far the call is. */
  onProgress?: (progress: Progress) => void;
}
