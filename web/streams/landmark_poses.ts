/** Poses of what a body tracker sees in a camera's picture. The page brings the tracker. */
import type { PoseSource } from "./pose_source";

/** Points that a tracker gives (BlazePose's numbering). */
export const LANDMARKS = 33;

/** A point of the body, metres about the middle of the hips: x to the right of the picture, y down, z away from the camera. */
export interface Landmark {
  /** To the right of the picture. */
  readonly x: number;
  /** Down. */
  readonly y: number;
  /** Away from the camera. */
  readonly z: number;
  /** From 0, hidden, to 1; a limb with a point below 0.5 keeps its pose. Without it the point is seen. */
  readonly visibility?: number;
}

/** Is called with the landmarks of every picture, and when it was taken, seconds. */
export type OnLandmarks = (landmarks: readonly Landmark[], secs: number) => void;

/** Options of `landmarkPoses`. */
export interface LandmarkOptions {
  /** Whether the tracker sees a mirrored picture. */
  readonly mirrored?: boolean;
}

/**
 * Poses of landmarks.
 * @param subscribe begins to call its argument with landmarks; what it gives back ends that
 */
export function landmarkPoses(
  subscribe: (onLandmarks: OnLandmarks) => () => void,
  { mirrored = false }: LandmarkOptions = {},
): PoseSource {
  return {
    start(sink, signal) {
      if (signal.aborted) return Promise.resolve();
      sink.skeleton({ kind: "landmarks", mirrored });
      const unsubscribe = subscribe((landmarks, secs) => {
        if (landmarks.length !== LANDMARKS) return;
        const numbers = new Float32Array(4 * LANDMARKS);
        for (const [i, { x, y, z, visibility = 1 }] of landmarks.entries()) numbers.set([x, y, z, visibility], 4 * i);
        sink.frame(secs, numbers);
      });
      return new Promise((resolve) => {
        const end = () => {
          unsubscribe();
          resolve();
        };
        signal.addEventListener("abort", end, { once: true });
      });
    },
  };
}
