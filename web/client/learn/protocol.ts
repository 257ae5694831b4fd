/**
 * What the lessons ask of the engine. Calls name all that they need, so that figures do not disturb each other: the worker
 * keeps what it opened, and opens the same thing once.
 */
import type {
  ClassDistances,
  Contacts,
  Fit,
  FitSettings,
  LensOptions,
  NearestWindows,
  QueryChange,
  Timing,
  WindowLength,
} from "../../engine/learn/lens";
import type { Compared, Stretch, WarpMethod } from "../../engine/learn/warps";
import type { Turn } from "../../engine/learn/wasm";
import type { Analysis, DatabaseInfo, Performed, StyleWeights, StylizeOptions } from "../../engine/types";

export type {
  Analysis,
  ClassDistances,
  Compared,
  Contacts,
  DatabaseInfo,
  Fit,
  FitSettings,
  LensOptions,
  NearestWindows,
  Performed,
  QueryChange,
  Stretch,
  StyleWeights,
  StylizeOptions,
  Timing,
  Turn,
  WarpMethod,
  WindowLength,
};

/** A motion that is styled. */
export interface LearnInput {
  /** Name of a built-in input, or of a walk or run of the database such as "walk-pace". */
  name: string;
  /** Joints that are turned in every frame. */
  turns?: readonly Turn[];
  /** Takes that are left out of the database, in any style. */
  without?: readonly string[];
}

/** A motion on the database's humanoid. */
export interface LearnMotion {
  /** `POSE_FLOATS` numbers a frame. */
  poses: Float32Array;
  /** Foot contacts, left and right interleaved, 1 while planted. */
  contacts: Uint8Array;
  rateHz: number;
  /** Offset of each joint from its parent in the T-pose, metres: 21 × xyz. */
  proportions: Float32Array;
  /** Degrees of freedom of every frame: 68 numbers a frame, of which the last is padding. */
  rows: Float32Array;
  /** Mean rotation of each joint, x y z w: the centres of the exponential maps. */
  means: Float32Array;
}

/** A frame of an input that takes on a style. */
export interface Look {
  input: LearnInput;
  styles: StyleWeights;
  /** The nearest frame that has two before it is looked at. */
  frame: number;
  /** Defaults are the engine's. */
  options?: Partial<LensOptions>;
}

/** Windows of a class that are asked for. */
export interface WindowsOrder {
  /** Number of the class; the heaviest where it is left out. */
  class?: number;
  /** Frames of a window; the engine's own has five. */
  length?: WindowLength;
  /** How the query differs from the input. */
  query?: QueryChange;
}

/** A frame as the engine styles it. */
export interface StyledLook {
  /** The styled pose. */
  pose: Float32Array;
  /** Seconds that it lasts. */
  secs: number;
  /** The class with the largest weight; `undefined` where none has neighbours. */
  heaviestClass: number | undefined;
}

/** A class's windows and their distances from the query. */
export interface Profile {
  class: number;
  /** The row that the first number is of. */
  firstRow: number;
  /** √D in metres of the window that ends at each row; NaN where none ends. */
  distances: Float32Array;
  /** The query's pose. */
  query: Float32Array;
}

/** A clip of the database that a lesson may compare. */
export interface LearnClip {
  /** Its number in the database. */
  clip: number;
  name: string;
  /** The row of its first frame, and how many it has. */
  first: number;
  frames: number;
  cycles: Stretch[];
  /** Planted feet, left and right interleaved. */
  contacts: Uint8Array;
}

/** How a call is made. */
export interface LearnCall {
  /** Ends the wait for the answer: the promise rejects with `cancelled`. */
  signal?: AbortSignal;
}

/** The lessons' engine. A call is a method here and an entry of the same name in the table of `learn_table.ts`. */
export interface LearnEngine {
  /** Names of the built-in inputs, the default first. */
  inputs(call?: LearnCall): Promise<string[]>;
  /** Names of the styles, neutral first. */
  styles(call?: LearnCall): Promise<string[]>;
  /** The built-in database. */
  database(call?: LearnCall): Promise<DatabaseInfo>;
  /** An input. @throws StrutError `bad-input` where there is none of the name */
  motion(input: LearnInput, call?: LearnCall): Promise<LearnMotion>;
  /** An input as a style performs it, frame for frame with the input; `undefined` where there is none. */
  counterpart(input: string, style: string, call?: LearnCall): Promise<Performed | undefined>;
  /** A whole input in other options. */
  stylize(input: LearnInput, options: StylizeOptions, call?: LearnCall): Promise<Analysis>;
  /** The frame as the engine styles it. */
  styled(look: Look, call?: LearnCall): Promise<StyledLook>;
  /** λ and D of every class (Eq. 3–5). */
  classes(look: Look, call?: LearnCall): Promise<ClassDistances>;
  /** The `k` windows of a class that are nearest to the query. */
  neighbours(look: Look, k: number, order: WindowsOrder, call?: LearnCall): Promise<NearestWindows>;
  /** How far all windows of a class are from the query. */
  profile(look: Look, order: WindowsOrder, call?: LearnCall): Promise<Profile>;
  /** The poses of rows of the database above the origin, heading along +Z. */
  rowPoses(rows: readonly number[], call?: LearnCall): Promise<Float32Array>;
  /** The line of one degree of freedom (Eq. 2). */
  fit(look: Look, settings: FitSettings, call?: LearnCall): Promise<Fit>;
  /** For each λ the error of a free-running prediction of the input, in the unit of the degree of freedom. */
  sweep(
    look: Look,
    settings: Omit<FitSettings, "lambda">,
    lambdas: readonly number[],
    call?: LearnCall,
  ): Promise<Float32Array>;
  /** How long the neighbours say that the frame lasts in a style with a weight. */
  timing(look: Look, style: string, call?: LearnCall): Promise<Timing>;
  /** Who says that the feet stand. */
  contacts(look: Look, call?: LearnCall): Promise<Contacts>;
  /** The clips of an action with their gait cycles. */
  clips(action: string, call?: LearnCall): Promise<LearnClip[]>;
  /** Two stretches of an action's clips, compared as registration compares them. */
  register(action: string, a: Stretch, b: Stretch, by: WarpMethod, call?: LearnCall): Promise<Compared>;
}
