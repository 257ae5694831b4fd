/** What a page says to a performer's stream, and what comes back. */
import type { BufferStats, Play } from "../../engine/live/pose_stream";
import type { StreamSkeleton } from "../../engine/live/skeleton";
import type { DatabaseInfo, Reading, StylizeOptions } from "../../engine/types";

/** A frame as it is shown. */
export interface StreamFrame {
  /** The styled pose. */
  pose: Float32Array;
  /** The performer's pose, on the body of the database. */
  inputPose: Float32Array;
  /** Feet that are held in place. */
  planted: [left: boolean, right: boolean];
  /** The heaviest classes that the engine recognises, heaviest first, at most three. */
  reads: Reading[];
  /** Number of the frame, from 0. */
  frame: number;
}

/** How a stream goes. */
export interface LiveStats extends BufferStats {
  /** What is shown now. */
  play: Play;
  /** Frames that were shown. */
  frames: number;
  /** From when a frame could have been shown at the earliest until it was styled, seconds: median and 95th percentile. */
  latencySecs: readonly [median: number, p95: number];
  /** Of which styling took so long with its way to the worker and back, seconds, in the median. */
  stylingSecs: number;
}

/** How a stream is made. */
export interface LiveSetup {
  /** How long frames wait, seconds; `undefined`: as long as their jitter asks. */
  delaySecs: number | undefined;
  /** Whether the figure is drawn to the performer's place, or goes where its steps lead. */
  follows: boolean;
  options: Partial<StylizeOptions>;
}

/** A performer who is styled as poses arrive. */
export interface PerformerStream {
  /** Is told every frame that is shown. */
  onFrame: ((frame: StreamFrame) => void) | undefined;
  readonly database: { readonly info: DatabaseInfo };
  readonly stats: LiveStats;
  /** Tells what the numbers of the next frames are. @throws StrutError where it is no skeleton; the one before stays */
  set skeleton(skeleton: StreamSkeleton);
  /**
   * Takes a frame that arrives now; whether it is used.
   * @throws StrutError if the first frame of a BVH file shows that it is no body's
   */
  push(sentSecs: number, numbers: Float32Array): boolean;
  /**
   * Goes on to the present: styles the frames that are due, and gives the last of them; `undefined` where there is none, because
   * nothing has come, the performer is lost, or it is not time yet.
   * @throws StrutError as from the engine; the next call goes on
   */
  advance(): Promise<StreamFrame | undefined>;
}
