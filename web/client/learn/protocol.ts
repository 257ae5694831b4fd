/**
 * The lessons' calls to the engine. Calls name everything they need, so that figures do not disturb each other. The
 * worker keeps the objects that it opened, and opens the same object once.
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

/** A motion to style. */
export interface LearnInput {
  /** Name of a built-in input, or of a walk or run of the database such as "walk-pace". */
  name: string;
  /** Joints that are rotated in every frame. */
  turns?: readonly Turn[];
  /** Rotation of the whole body about the vertical through the first frame's hips, radians. */
  heading?: number;
  /** Takes that are left out of the database, in all styles. */
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

/** A frame of an input while it is styled. */
export interface Look {
  input: LearnInput;
  styles: StyleWeights;
  /** Frame to inspect; the nearest one with two frames before it is used. */
  frame: number;
  /** Defaults are the engine's. */
  options?: Partial<LensOptions>;
}

/** A request for windows of a class. */
export interface WindowsOrder {
  /** Index of the class; by default the heaviest. */
  class?: number;
  /** Frames of a window; the engine uses five. */
  length?: WindowLength;
  /** How the query differs from the input. */
  query?: QueryChange;
}

/** A frame as styled by the engine. */
interface StyledLook {
  /** The styled pose. */
  pose: Float32Array;
  /** Its duration, seconds. */
  secs: number;
  /** The class with the largest weight; `undefined` if no class has neighbours. */
  heaviestClass: number | undefined;
}

/** A class's windows and their distances from the query. */
export interface Profile {
  class: number;
  /** The row of the first number. */
  firstRow: number;
  /** √D in metres of the window that ends at each row; NaN where no window ends. */
  distances: Float32Array;
  /** The query's pose. */
  query: Float32Array;
}

/** A clip of the database that a lesson may compare. */
interface LearnClip {
  /** Its index in the database. */
  clip: number;
  name: string;
  /** The row of its first frame, and its number of frames. */
  first: number;
  frames: number;
  cycles: Stretch[];
  /** Foot contacts, left and right interleaved. */
  contacts: Uint8Array;
}

/** A degree of freedom of a synthesised walk: a joint's index, and an axis of its own frame, 0 to 2. */
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

/** Training data of the key-styling lesson: walks of the built-in database. */
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
  /** Number of updates in a pass, and in all passes. */
  frames: number;
  total: number;
}

/** The pose of the last update's sample, and the network's current prediction from its variables. */
export interface SamplePoses {
  sample: Float32Array;
  /** Prediction of the component that is likeliest for the variables; not finite once learning has diverged. */
  predicted: Float32Array;
  /** Mean angle between the joints of the two, degrees. */
  apart: number;
}

/** How components are blended into poses; see `PoseMode`. */
export interface PoseSharing {
  temperature: number;
  blur: number;
}

/** How smoothly a character can be dragged. */
export interface Dragged {
  /** Largest rotation of a joint from frame to frame on ten fixed drags, degrees. */
  change: number;
  /** Mean angle between the joints of the training poses and of those predicted from their variables, degrees. */
  error: number;
}

/** A cycle interpolated from keys. */
export interface Keyed {
  /** Mean angle of the joints from the recorded cycle at each frame, degrees. */
  errors: Float32Array;
  /** The style variables at each frame. */
  values: Float32Array;
}

/** Options of a call. */
interface LearnCall {
  /** Cancels the wait for the answer: the promise rejects with `cancelled`. */
  signal?: AbortSignal;
}

/** The lessons' engine. Each call is a method here and an entry of the same name in the table of `learn_table.ts`. */
export interface LearnEngine {
  /** Names of the built-in inputs, the default first. */
  inputs(call?: LearnCall): Promise<string[]>;
  /** Names of the styles, neutral first. */
  styles(call?: LearnCall): Promise<string[]>;
  /** The built-in database. */
  database(call?: LearnCall): Promise<DatabaseInfo>;
  /** An input. @throws StrutError `bad-input` if there is no input of this name */
  motion(input: LearnInput, call?: LearnCall): Promise<LearnMotion>;
  /** An input as performed in a style, frame by frame with the input; `undefined` if there is none. */
  counterpart(input: string, style: string, call?: LearnCall): Promise<Performed | undefined>;
  /** A whole input with other options. */
  stylize(input: LearnInput, options: StylizeOptions, call?: LearnCall): Promise<Analysis>;
  /** The frame as styled by the engine. */
  styled(look: Look, call?: LearnCall): Promise<StyledLook>;
  /** λ and D of every class (Eq. 3–5). */
  classes(look: Look, call?: LearnCall): Promise<ClassDistances>;
  /** The `k` windows of a class nearest to the query. */
  neighbours(look: Look, k: number, order: WindowsOrder, call?: LearnCall): Promise<NearestWindows>;
  /** Distances of all windows of a class from the query. */
  profile(look: Look, order: WindowsOrder, call?: LearnCall): Promise<Profile>;
  /** The poses of rows of the database, moved above the origin and turned to face +Z. */
  rowPoses(rows: readonly number[], call?: LearnCall): Promise<Float32Array>;
  /** The fitted line of one degree of freedom (Eq. 2). */
  fit(look: Look, settings: FitSettings, call?: LearnCall): Promise<Fit>;
  /** For each λ, the error of a free-running prediction of the input, in the unit of the degree of freedom. */
  sweep(
    look: Look,
    settings: Omit<FitSettings, "lambda">,
    lambdas: readonly number[],
    call?: LearnCall,
  ): Promise<Float32Array>;
  /** Predicted duration of the frame, by the neighbours in a style that has a weight. */
  timing(look: Look, style: string, call?: LearnCall): Promise<Timing>;
  /** Votes for the foot contacts. */
  contacts(look: Look, call?: LearnCall): Promise<Contacts>;
  /** The clips of an action with their gait cycles. */
  clips(action: string, call?: LearnCall): Promise<LearnClip[]>;
  /** The likeliest trajectory of a degree of freedom over a left and a right step, by the built-in walk model. */
  walkPath(styles: StyleWeights, dof: WalkDof, options: PathOptions, call?: LearnCall): Promise<JointPath>;
  /** The first frames of a walk that the built-in walk model synthesises. */
  walk(styles: StyleWeights, frames: number, call?: LearnCall): Promise<Walked>;
  /** The training data of the key styles. */
  styleSamples(call?: LearnCall): Promise<StyleSamples>;
  /** The network after `updates` updates, with the correct signs or those printed in the paper. */
  somn(updates: number, asPrinted: boolean, call?: LearnCall): Promise<SomnSnapshot>;
  /** The last sample of {@link somn} and its prediction; `undefined` before the first update. */
  somnPoses(updates: number, asPrinted: boolean, call?: LearnCall): Promise<SamplePoses | undefined>;
  /** {@link Dragged.error} of the models after each pass of the training, with hard sharing. */
  somnErrors(call?: LearnCall): Promise<Float32Array>;
  /** How smoothly the trained model can be dragged. */
  dragged(sharing: PoseSharing, call?: LearnCall): Promise<Dragged>;
  /** The pose of two style variables, and the weight of each component in it. */
  stylePose(
    values: readonly number[],
    sharing: PoseSharing,
    call?: LearnCall,
  ): Promise<{ pose: Float32Array; weights: Float32Array }>;
  /** The cycle interpolated from keys at some of its frames, in order, each with its recorded variables. */
  keyed(frames: readonly number[], call?: LearnCall): Promise<Keyed>;
  /** Two ranges of an action's clips, compared as in registration. */
  register(action: string, a: Stretch, b: Stretch, by: WarpMethod, call?: LearnCall): Promise<Compared>;
}
