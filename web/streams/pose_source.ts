/** Where live poses come from, and where they go. */
import type { StreamSkeleton } from "../engine/live/skeleton";

export type { StreamSkeleton } from "../engine/live/skeleton";

/** Takes what a source gives. Until a skeleton is told, poses are on the body of the database. */
export interface PoseSink {
  /** Tells what the numbers of the next frames are. */
  skeleton(skeleton: StreamSkeleton): void;
  /**
   * A frame.
   * @param secs when it was sent, seconds on a clock of the sender's
   * @param pose as many numbers as the skeleton says; copied
   */
  frame(secs: number, pose: Float32Array): void;
  /** Nothing comes for now; a sentence says why. */
  lost(why: string): void;
}

/** A performer: a socket, a camera, or anything else that has poses as they happen. */
export interface PoseSource {
  /**
   * Gives poses to `sink` until `signal` aborts, and then resolves.
   * @throws StrutError where nothing can come
   */
  start(sink: PoseSink, signal: AbortSignal): Promise<void>;
}
