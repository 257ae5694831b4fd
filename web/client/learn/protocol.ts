/**
 * What the lessons ask of the engine. Calls name all that they need, so that figures do not disturb each other: the worker
 * keeps what it opened, and opens the same thing once.
 */

import type { SomnState } from "../../engine/key_style/somn";
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
import type { JointPath, PathOptions } from "../../engine/walk/walker";

export type {
  Analysis,
  ClassDistances,
  Compared,
  Contacts,
  DatabaseInfo,
  Fit,
  FitSettings,
  JointPath,
  LensOptions,
  NearestWindows,
  PathOptions,
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
  /** Turn of the whole about the vertical through the first frame's hips, radians. */
  heading?: number;
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

/** A degree of freedom of a synthesised walk: a joint's number, and an axis of its own frame, 0 to 2. */
export interface WalkDof {
  joint: number;
  axis: number;
}

/** A synthesised walk. */
export interface Walked {
  /** `POSE_FLOATS` numbers a frame. */
  poses: Float32Array;
  rateHz: number;
  /** Offset of each joint from its parent in the T-pose, metres: 21 × xyz. */
  proportions: Float32Array;
}

/** What the lesson about key-styling is learned from: walks of the built-in database. */
export interface StyleSamples {
  /** Two style variables of every training frame, frame after frame, and their units. */
  values: Float32Array;
  units: readonly string[];
  rateHz: number;
  proportions: Float32Array;
  /** A gait cycle among the training frames. */
  cycle: { first: number; frames: number };
}

/** A self-organising mixture network after some updates. */
export interface SomnSnapshot extends SomnState {
  /** Updates in a pass, and in all passes. */
  frames: number;
  total: number;
}

/** The pose of the last update's sample, and what the network predicts for its variables now. */
export interface SamplePoses {
  sample: Float32Array;
  /** By the component that is likeliest for the variables; no finite numbers once learning has diverged. */
  predicted: Float32Array;
  /** Mean angle of the joints between the two, degrees. */
  apart: number;
}

/** How poses follow the style variables; see `PoseMode`. */
export interface PoseSharing {
  temperature: number;
  blur: number;
}

/** How well a character can be dragged. */
export interface Dragged {
  /** Greatest turn of a joint from frame to frame on ten fixed drags, degrees. */
  change: number;
  /** Mean angle between joints of the training poses and those that their variables give, degrees. */
  error: number;
}

/** A cycle that is interpolated from keys. */
export interface Keyed {
  /** Mean angle of the joints from the recorded cycle at each frame, degrees. */
  errors: Float32Array;
  /** The style variables at each frame. */
  values: Float32Array;
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
  /** The likeliest trajectory of a degree of freedom over a left and a right step of the built-in walk model. */
  walkPath(styles: StyleWeights, dof: WalkDof, options: PathOptions, call?: LearnCall): Promise<JointPath>;
  /** The first frames of a walk that the built-in walk model synthesises. */
  walk(styles: StyleWeights, frames: number, call?: LearnCall): Promise<Walked>;
  /** What key styles are learned from. */
  styleSamples(call?: LearnCall): Promise<StyleSamples>;
  /** The network after so many updates, with the signs as they are or as the paper prints them. */
  somn(updates: number, asPrinted: boolean, call?: LearnCall): Promise<SomnSnapshot>;
  /** The last sample of {@link somn} and its prediction; `undefined` before the first update. */
  somnPoses(updates: number, asPrinted: boolean, call?: LearnCall): Promise<SamplePoses | undefined>;
  /** {@link Dragged.error} of the models that learning makes after each pass, hard shares. */
  somnErrors(call?: LearnCall): Promise<Float32Array>;
  /** How well the learned model can be dragged. */
  dragged(sharing: PoseSharing, call?: LearnCall): Promise<Dragged>;
  /** The pose of two style variables, and the weight of each component in it. */
  stylePose(
    values: readonly number[],
    sharing: PoseSharing,
    call?: LearnCall,
  ): Promise<{ pose: Float32Array; weights: Float32Array }>;
  /** The cycle from keys at some of its frames, in order, each with its recorded variables. */
  keyed(frames: readonly number[], call?: LearnCall): Promise<Keyed>;
  /** Two stretches of an action's clips, compared as registration compares them. */
  register(action: string, a: Stretch, b: Stretch, by: WarpMethod, call?: LearnCall): Promise<Compared>;
}
