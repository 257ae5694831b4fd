import { expect, it } from "vitest";
import { cycleOf, keysOfCycle, keysOfRecording } from "./first_keys";

/** Two variables with a period of 36 frames. */
const round = Float32Array.from({ length: 400 }, (_, i) => {
  const angle = (2 * Math.PI * Math.floor(i / 2)) / 36;
  return i % 2 === 0 ? 30 * Math.cos(angle) : 5 * Math.sin(angle);
});
const DEVIATION = [21, 3.5];

it("finds a turn, and not two of them", () => {
  expect(cycleOf(round, DEVIATION)).toMatchObject({ frames: 36 });
});

it("finds none where there is none", () => {
  const ahead = Float32Array.from({ length: 400 }, (_, i) => i);
  expect(cycleOf(ahead, [50, 50])).toBeUndefined();
  expect(cycleOf(new Float32Array(400), DEVIATION), "a motionless clip has no cycle").toBeUndefined();
  expect(cycleOf(round.subarray(0, 20), DEVIATION)).toBeUndefined();
});

it("takes keys of a turn that end where they begin", () => {
  const keys = keysOfCycle(round, 2, { first: 0, frames: 36 }, 30);
  expect(keys).toHaveLength(9);
  expect(keys.at(-1)).toEqual({ secs: 1.2, values: keys[0]!.values });
  expect(keys[4]!.values[0]).toBeCloseTo(-30);
  expect(keys[1]!.values[0]).toBeCloseTo(30 * Math.cos(Math.PI / 4), 0);
});

it("takes keys of a recording, ten frames apart", () => {
  const keys = keysOfRecording(round, 2, 30);
  expect(keys.map(({ secs }) => secs)).toEqual([0, 1, 2, 3, 4, 5, 6, 7].map((i) => i / 3));
  expect(keys[1]!.values[0]).toBe(round[20]);
  expect(keysOfRecording(round.subarray(0, 24), 2, 30)).toHaveLength(2);
});
