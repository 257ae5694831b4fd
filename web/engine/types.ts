/**
 * Inputs and outputs of the engine.
 *
 * Poses are `Float32Array`s of `POSE_FLOATS` numbers a frame: root x y z in metres, then the quaternion x y z w of the
 * 21 joints of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), each relative to its parent, the hips
 * relative to the world. Times are seconds.
 */

import type { Role } from "../humanoid";

/** A database that is open in the worker. */
export interface DatabaseInfo {
  /** Name of the file without its ending, or of the built-in database. */
  name: string;
  /** Number of frames of all clips. */
  frames: number;
  /** Frames per second of every clip. */
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

/** Joints by role, by their names; `null` means that the skeleton has no such joint. */
export type JointNames = Readonly<Partial<Record<Role, string | null>>>;

/** What the user specifies for a file, overriding what is detected from the body. Missing properties are detected. */
export interface FileReading {
  /** The file's up axis. */
  up?: UpAxis;
  /** Height of the floor along the up axis, metres. */
  floor?: number;
  /** Whether left and right are the opposite of what is detected. */
  swapSides?: boolean;
  /** Whether the file is a mirror image, whatever is detected from the body. It overrides `swapSides`. */
  mirrored?: boolean;
  /** Metres per unit of length. */
  unit?: number;
  /** The joint of each role; joints of missing roles are found automatically. */
  joints?: JointNames;
}

/** A possible problem in how a motion was read. */
export interface Note {
  /** The kind of problem; docs/reading.md lists the codes. */
  code: string;
  /** The sentence to show. */
  text: string;
}

/** How a file was read, and the source of each property. */
export interface FileRead {
  /** Frames of the file. */
  frames: number;
  /** Frames per second of the file. */
  rateHz: number;
  /** The file's up axis. */
  up: UpAxis;
  /** Whether +Y was used unchanged, the axis was guessed from the body, or the user specified it. */
  upFrom: "as-is" | "guessed" | "said";
  /** Whether left and right are swapped because the file is a mirror image. */
  mirrored: boolean;
  /** Whether the sides are as named, were guessed from the body, or the user specified them. */
  sidesFrom: "as-is" | "guessed" | "said";
  /** Height of the floor along the up axis, metres. */
  floorMetres: number;
  /** Whether the floor was measured, or the user specified it. */
  floorFrom: "measured" | "said";
  /** Metres per unit of length. */
  metresPerUnit: number;
  /** Whether the unit was measured on the body, or the user specified it. */
  unitFrom: "measured" | "said";
  /** Height of the body, metres. */
  heightMetres: number;
  /** The joint of each role. */
  joints: Readonly<Record<Role, string | null>>;
  /** Whether all joints were found by their names, some by the shape of the skeleton, or the user specified some. */
  jointsFrom: "names" | "shape" | "said";
  /** The skeleton: its identity, which is equal for equal names in an equal hierarchy, and the names of its joints. */
  skeleton: { id: string; joints: readonly string[] };
  /** The guessed properties that the user can specify instead. */
  guesses: readonly ("up" | "sides" | "joints")[];
  /** What the user specified. */
  said: FileReading;
  /** Whether that was specified for an earlier file with the same skeleton. */
  remembered: boolean;
}

/** Facts of a motion's file, before it is retargeted to a database. */
export interface MotionFacts {
  /** Frames of the file. */
  frames: number;
  /** Frames per second of the file. */
  rateHz: number;
  /** Length, seconds. */
  durationSecs: number;
  /** A sentence for the user about the joint mapping; empty if there is nothing to report. */
  note: string;
  /** Possible problems in how the file was read. */
  notes: readonly Note[];
  /** How the file was read; `undefined` for a motion without a file. */
  reading: FileRead | undefined;
}

/** Memory of the engine. */
export interface WasmMemory {
  /** Size of its linear memory, bytes. It grows with what is open and never shrinks. */
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
  /** Sentences for the user on possible problems and the joint mapping; empty if there is nothing to report. */
  note: string;
  /** Possible problems in how it was read. */
  notes: readonly Note[];
  /** How its file was read; `undefined` for a motion without a file. */
  reading: FileRead | undefined;
  /** The input on the database's humanoid, `frames` poses. */
  poses: Float32Array;
  /** Foot contacts of the input, left and right interleaved, 1 while planted. */
  contacts: Uint8Array;
}

/** Parts of the body that may have styles of their own, in the engine's order (`transfer/body_part.rs`). */
export const BODY_PARTS = ["head", "torso", "left_arm", "right_arm", "legs"] as const;
/** A part of the body. */
export type BodyPart = (typeof BODY_PARTS)[number];

/**
 * Methods that predict a pose from the neighbours (`transfer/options.rs`). The mixture of autoregressive models is the
 * default.
 */
export const METHODS = ["mar", "lar", "knn", "nn"] as const;
export type Method = (typeof METHODS)[number];

/** Baseline methods with training (`rust/strut-evaluation/src/baselines/`). Only the Compare view's package has them. */
export const TRAINED_METHODS = ["gar", "lti", "gp"] as const;
type TrainedMethod = (typeof TRAINED_METHODS)[number];

/** Weight of each style by name; the remainder to 1 belongs to the neutral style. */
export type StyleWeights = Readonly<Record<string, number>>;

/** The styles that a style track has reached at an input frame. */
export interface StyleKey {
  /** Input frame. */
  frame: number;
  /** Styles of the whole body. */
  styles: StyleWeights;
}

/** All options that change the output; the defaults are the engine's. */
export interface StylizeOptions {
  /** Styles of the whole body. */
  styles: StyleWeights;
  /** Styles of the parts of the body that have their own. */
  parts: Readonly<Partial<Record<BodyPart, StyleWeights>>>;
  /** Styles of the whole body over time, ordered by frame; without keys, {@link styles} throughout. */
  track: readonly StyleKey[];
  /** Neighbours in each class. */
  k: number;
  /** Ridge regularisation, in units of K. */
  lambda: number;
  /** ρ: share of the bias that is added back, 0–1. */
  rho: number;
  /** κ: deviations beyond which the input counts as bias. */
  kappa: number;
  /** δ: width of the mixture; higher mixes more classes. */
  delta: number;
  /** η: how much of the tempo of a walk or a run is the style's; 0 keeps the input's, 1 ignores it. */
  tempo: number;
  /** Whether temporal coherence suppresses jitter where the input is far from the database; method `mar` only. */
  coherence: boolean;
  /** Whether the output has its own timing. */
  timing: boolean;
  /** Whether planted feet are held in place. */
  footplant: boolean;
  /** Method that predicts a pose from the neighbours. */
  method: Method | TrainedMethod;
  /** The known action of the input; empty if the engine is to recognise it. */
  action: string;
  /** The known style of the input; empty if the engine is to recognise it. */
  inputStyle: string;
}

/** Options without the styles. */
export type ModelOptions = Omit<StylizeOptions, "styles" | "parts" | "track">;

/** The engine's defaults (`rust/strut-core/src/transfer/options.rs` gives the reasons), in the neutral style. */
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

/** One class of the database and how strongly the engine recognises the input as it. */
export interface Reading {
  /** Its action. */
  action: string;
  /** Its style. */
  style: string;
  /** Share of the prediction that comes from this class, 0–1. */
  weight: number;
}

/** The whole input in the current style: drawn by the timeline and exported. */
export interface Analysis {
  /** Styled poses, one an input frame. */
  poses: Float32Array;
  /** Output time of each input frame. */
  timeOut: Float32Array;
  /** Foot contacts of the output, left and right interleaved, one pair per input frame. */
  planted: Uint8Array;
  /** Weight of each class of the database in each frame. */
  classWeights: Float32Array;
  /** Length of the output, seconds. */
  durationOutSecs: number;
  /** Possible problems of the output, in addition to the notes on the input. */
  notes: readonly Note[];
  /** Mean distance of the input's frames from the nearest ones of the database, metres; `undefined` for a built-in input. */
  distanceMetres: number | undefined;
}

/** A batch of styled frames, one per input frame. */
export interface Styled {
  /** Poses. */
  poses: Float32Array;
  /** Seconds since the previous frame; 0 for the first after a reset. */
  durations: Float32Array;
  /** Feet held in place, left and right interleaved. */
  planted: Uint8Array;
  /** Weight of each class of the database in the last frame. */
  classWeights: Float32Array;
}

/** A motion that was performed in a style, not styled. It corresponds to its input frame by frame. */
export type Performed = Pick<Analysis, "poses" | "timeOut" | "planted">;

/** A search by kd-trees compared with the exact one, over a whole motion. */
export interface SearchFigures {
  /** Share of the nearest windows of every class that kd-trees find, 0–1. */
  recall: number;
  /** Median time of a frame's exact search in all classes, milliseconds. */
  exactMs: number;
  /** Median time of a frame's search by kd-trees in all classes, milliseconds. */
  treesMs: number;
}

/** Quantity that a curve shows of a pose: the rotation of a joint, by its index, or the height of the hips. */
export type CurveSubject = number | "height";

/** The examples of the database from which each frame of a clip was predicted, in the requested styles. */
export interface Examples {
  subject: CurveSubject;
  /** Number of examples of each frame, the nearest first. */
  counts: Uint16Array;
  /** Weight of each example, 0–1, frame after frame. */
  weights: Float32Array;
  /** The quaternion x y z w of the joint in each example, or the height of the hips in metres. */
  values: Float32Array;
}

/** Progress of a long call. */
export interface Progress {
  /** What is being done, for the user. */
  label: string;
  /** 0–1. */
  fraction: number;
}

/** Options of every call that may take long. */
export interface CallOptions {
  /** Cancels the call, which then rejects with `cancelled`. */
  signal?: AbortSignal;
  /** Receives the progress of the call. */
  onProgress?: (progress: Progress) => void;
}
