import { expect, test } from "vitest";
import { LANDMARKS, type Landmark, landmarkPoses, type OnLandmarks } from "./landmark_poses";

test("landmarks are frames until the signal aborts", async () => {
  const said: unknown[] = [];
  const sink = {
    skeleton: (skeleton: unknown) => said.push(skeleton),
    frame: (secs: number, pose: Float32Array) => said.push([secs, pose.length, pose[4], pose[7]]),
    lost: () => {},
  };
  let see: OnLandmarks | undefined;
  const subscribe = (onLandmarks: OnLandmarks) => {
    see = onLandmarks;
    return () => {
      see = undefined;
    };
  };
  const ending = new AbortController();
  const ended = landmarkPoses(subscribe, { mirrored: true }).start(sink, ending.signal);
  const points = Array.from({ length: LANDMARKS }, (_, i): Landmark => ({ x: i, y: 0, z: 0 }));
  see!(points, 1.5);
  // An incomplete body gives no frame.
  see!(points.slice(1), 1.6);
  expect(said).toEqual([{ kind: "landmarks", mirrored: true }, [1.5, 132, 1, 1]]);
  ending.abort();
  await ended;
  expect(see).toBeUndefined();
});
