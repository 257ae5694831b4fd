/** What the lessons ask of the engine. */
import type { Performed } from "../../engine/types";

export type { Performed };

/** A built-in input on the database's humanoid. */
export interface LearnMotion {
  /** `POSE_FLOATS` numbers a frame. */
  poses: Float32Array;
  /** Foot contacts, left and right interleaved, 1 while planted. */
  contacts: Uint8Array;
  rateHz: number;
  /** Offset of each joint from its parent in the T-pose, metres: 21 × xyz. */
  proportions: Float32Array;
}

/** How a call is made. */
export interface LearnCall {
  /** Ends the wait for the answer: the promise rejects with `cancelled`. */
  signal?: AbortSignal;
}

/** The lessons' engine. A call is a method here and an entry of the same name in the table of `learn_worker.ts`. */
export interface LearnEngine {
  /** Names of the built-in inputs, the default first. */
  inputs(call?: LearnCall): Promise<string[]>;
  /** Names of the styles, neutral first. */
  styles(call?: LearnCall): Promise<string[]>;
  /** A built-in input. @throws StrutError `bad-input` where there is none of the name */
  motion(input: string, call?: LearnCall): Promise<LearnMotion>;
  /** A built-in input as a style performs it, frame for frame with the input; `undefined` where there is none. */
  counterpart(input: string, style: string, call?: LearnCall): Promise<Performed | undefined>;
}
