import { expect, test } from "vitest";
import { StyleColours } from "./colours";
import { alongAxes } from "./handles";
import { dense, routeOf } from "./route";
import { tintsOf } from "./tints";
import { crowdTitle } from "./titles";

const vertex = (style: string) => ({ style, x: 0, z: 0, reach: 1, intensity: 1 });

test("everybody is tinted by what they walk in", () => {
  const tints = new Uint8Array(12);
  tintsOf(Uint8Array.of(0, 0, 255, 0, 51, 51), [[200, 0, 0], [0, 100, 0]], tints); // biome-ignore format: two colours
  expect([...tints]).toEqual([0, 0, 0, 0, 200, 0, 0, 89, 100, 50, 0, 35]);
});

test("a style keeps its colour while it is in the field", () => {
  const colours = new StyleColours();
  colours.take(["proud", "old"]);
  const [proud, old] = [colours.of("proud"), colours.of("old")];
  colours.take(["old", "angry"]);
  expect([colours.of("old"), colours.of("angry")]).toEqual([old, proud]);
  expect(colours.of("proud")).toBe(colours.average);
});

test("arrows go along the axes of the ground, as the camera sees them", () => {
  expect(alongAxes(1, 0, 0.3)).toEqual([1, 0]);
  expect(alongAxes(0, 1, 0.3)).toEqual([0, -1]);
  // From the right: what is to the right is away from the first camera.
  expect(alongAxes(1, 0, Math.PI / 2)).toEqual([0, -1]);
  expect(alongAxes(0, 1, Math.PI / 2)).toEqual([-1, 0]);
});

test("a drawn line becomes a route of at most 64 points", () => {
  expect(routeOf([[0, 0], [0.1, 0], [0.2, 0]])).toEqual([]); // biome-ignore format: places
  expect(routeOf([[0, 0], [0.1, 0], [0.6, 0], [2, 0]])).toEqual([[0, 0], [0.6, 0], [2, 0]]); // biome-ignore format: places
  const long = routeOf(Array.from({ length: 500 }, (_, i) => [0.19 * i, 0] as const));
  expect(long.length).toBe(64);
  expect(long.at(-1)![0]).toBeGreaterThan(94);
  const round = routeOf(
    Array.from({ length: 80 }, (_, i) => [5 * Math.cos(i / 12.9), 5 * Math.sin(i / 12.9)] as const),
  );
  expect(round.at(-1)).toEqual(round[0]);
});

test("a line on the ground has a point every half metre", () => {
  expect(dense([[0, 0], [0, 1]])).toEqual([[0, 0], [0, 0.5], [0, 1]]); // biome-ignore format: places
  expect(dense([])).toEqual([]);
});

test("titles say how many and how", () => {
  const field = ["proud", "old", "proud"].map(vertex);
  expect(crowdTitle("walkers", 200, field)).toBe("Two hundred people, two ways of walking");
  expect(crowdTitle("walkers", 1, [])).toBe("One person, one way of walking");
  expect(crowdTitle("walkers", 1000, field.slice(0, 1))).toBe("One thousand people, one style");
  expect(crowdTitle("walkers", 257, field)).toBe("257 people, two ways of walking");
  expect(crowdTitle("performers", 200, field)).toBe("Two hundred people, two styles");
  expect(crowdTitle("performers", 2, [])).toBe("Two people, no style");
});
