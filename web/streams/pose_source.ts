/** Sources and receivers of live poses. */
import type { StreamSkeleton } from "../engine/live/skeleton";

export type { StreamSkeleton } from "../engine/live/skeleton";

/** Receives the output of a source. Until a skeleton is set, poses are on the body of the database. */
export interface PoseSink {
  /** Sets the skeleton of the next frames. */
  skeleton(skeleton: StreamSkeleton): void;
  /**
   * Receives a frame.
   * @param secs when it was sent, seconds on a clock of the sender
   * @param pose numbers according to the skeleton; copied
   */
  frame(secs: number, pose: Float32Array): void;
  /** Reports that no frames arrive at present, with the reason as a sentence. */
  lost(why: string): void;
}

/** A source of live poses: a socket, a camera, or anything else. */
export interface PoseSource {
  /**
   * Sends poses to `sink` until `signal` aborts, and then resolves.
   * @throws StrutError if no poses can be received
   */
  start(sink: PoseSink, signal: AbortSignal): Promise<void>;
}
