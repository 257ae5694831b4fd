/** Messages between a page and a performer's stream. */
import type { BufferStats, Play } from "../../engine/live/pose_stream";
import type { Reading, StylizeOptions } from "../../engine/types";

/** A displayed frame. */
export interface StreamFrame {
  /** The styled pose. */
  pose: Float32Array;
  /** The performer's pose, on the body of the database. */
  inputPose: Float32Array;
  /** Feet that are held in place. */
  planted: [left: boolean, right: boolean];
  /** The classes that the engine recognises with the largest weights, largest first, at most three. */
  reads: Reading[];
  /** Index of the frame, from 0. */
  frame: number;
}

/** Statistics of a stream. */
export interface LiveStats extends BufferStats {
  /** Kind of the frame displayed now. */
  play: Play;
  /** Number of displayed frames. */
  frames: number;
  /**
   * Time from when a frame could have been displayed at the earliest until it was styled, seconds: median and 95th
   * percentile.
   */
  latencySecs: readonly [median: number, p95: number];
  /** Median styling time including the round trip to the worker, seconds. */
  stylingSecs: number;
}

/** Settings of a stream. */
export interface LiveSetup {
  /** Buffering delay of frames, seconds; `undefined` adapts it to their jitter. */
  delaySecs: number | undefined;
  /** Whether the character is pulled to the performer's position, or moves freely with its own steps. */
  follows: boolean;
  options: Partial<StylizeOptions>;
}
