/** Poses from a body tracker on a camera image. The page provides the tracker. */
import type { PoseSource } from "./pose_source";

/** Number of points of a tracker (BlazePose's numbering). */
export const LANDMARKS = 33;

/** A point of the body, metres about the middle of the hips: x to the right of the image, y down, z away from the camera. */
export interface Landmark {
  /** To the right of the image. */
  readonly x: number;
  /** Down. */
  readonly y: number;
  /** Away from the camera. */
  readonly z: number;
  /** From 0, hidden, to 1; a limb with a point below 0.5 keeps its pose. Without it the point counts as visible. */
  readonly visibility?: number;
}

/** Receives the landmarks of every image, and the time when it was taken, seconds. */
export type OnLandmarks = (landmarks: readonly Landmark[], secs: number) => void;

/** Options of `landmarkPoses`. */
export interface LandmarkOptions {
  /** Whether the tracker's image is mirrored. */
  readonly mirrored?: boolean;
}

/**
 * Poses from landmarks.
 * @param subscribe starts to call its argument with landmarks; returns a function that stops it
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
