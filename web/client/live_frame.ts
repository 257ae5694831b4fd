/** A displayed frame. */
import type { Reading } from "../engine/types";

/** The displayed state at one instant of live playback. */
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
  /** The recognised classes with the largest weights, largest first, at most three. */
  reads: Reading[];
  /** Mean cost of the last styled frames in the engine, milliseconds. */
  frameMs: number;
  /** Whether the clip looped since the last frame. */
  looped: boolean;
  /** Whether the end was reached and looping is off. */
  ended: boolean;
}
