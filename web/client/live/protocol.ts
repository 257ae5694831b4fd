/** Messages between a page and a performer's stream. */
import type { BufferStats, Play } from "../../engine/live/pose_stream";
import type { StreamSkeleton } from "../../engine/live/skeleton";
import type { DatabaseInfo, Reading, StylizeOptions } from "../../engine/types";

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

/** A performer styled as poses arrive. */
export interface PerformerStream {
  /** Receives every displayed frame. */
  onFrame: ((frame: StreamFrame) => void) | undefined;
  readonly database: { readonly info: DatabaseInfo };
  readonly stats: LiveStats;
  /** Sets the skeleton of the next frames. @throws StrutError if it is invalid; the previous one stays in use */
  set skeleton(skeleton: StreamSkeleton);
  /**
   * Accepts a frame that arrives now. Returns whether it is used.
   * @throws StrutError if the first frame of a BVH file shows that its skeleton is not a body
   */
  push(sentSecs: number, numbers: Float32Array): boolean;
  /**
   * Advances to the current time: styles the frames that are due and returns the last of them. Returns `undefined` if
   * there is none, because nothing has arrived, the performer is lost, or it is too early.
   * @throws StrutError as from the engine; the next call continues
   */
  advance(): Promise<StreamFrame | undefined>;
}
