// A camera's landmarks, docs/live.md: `npm test` checks the types.
import type { Landmark } from "strut-motion/streams";

/** A body tracker of the page. */
declare const tracker: {
  onResult: (result: { worldLandmarks: Landmark[]; secs: number }) => void;
  stop(): void;
};

// anchor landmarks
import { landmarkPoses } from "strut-motion/streams";

const source = landmarkPoses(
  (onLandmarks) => {
    tracker.onResult = ({ worldLandmarks, secs }) => onLandmarks(worldLandmarks, secs); // 33 × { x, y, z, visibility }
    return () => tracker.stop();
  },
  { mirrored: true },
);
// end landmarks

console.log(source);
