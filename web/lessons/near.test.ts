import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { align, positionsOf, WEIGHTS } from "../element/figure/near/alignment";
import { distanceOf, foundOf, measureNear } from "../element/figure/near/near_measure";
import { changeOf, lookOf, NEAR_FIELDS, type NearState } from "../element/figure/near/near_state";
import { serveLearnPackage } from "../engine/learn/wasm";
import { JOINT, type Role } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { near } from "./near";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(NEAR_FIELDS);
const exercise = (id: string) => near.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<NearState>) =>
  judge(exercise(id), await measureNear(engine, { ...readHash(NEAR_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: a turn and a move change nothing", async () => {
  const { answer, measure } = await near.bet.reveal(engine);
  expect(answer).toBe("same");
  expect(Number(measure.before)).toBeGreaterThan(1);
});

test("the distance of one frame is what is left after the best of many turns and shifts", async () => {
  const { proportions } = await engine.motion({ name: PRESET.motion });
  const state: NearState = {
    ...PRESET,
    window: "1",
    heading: 70,
    x: 0.4,
    turned: [{ joint: "left_upper_arm", by: [0, 0, 30] }],
  };
  const found = await foundOf(engine, state);
  const row = found.firstRow + found.order[0]!;
  const pose = await engine.rowPoses([row]);
  const [query, example] = [found.query, pose].map((one) => positionsOf(one, proportions)) as [
    Float32Array,
    Float32Array,
  ];
  const points = Object.entries(WEIGHTS).map(([role, weight]) => [3 * JOINT[role as Role], weight] as const);
  const total = points.reduce((sum, [, weight]) => sum + weight, 0);
  /** D at a turn; the shift that is best at it brings the centres together. */
  const at = (turn: number) => {
    const turned = (i: number) => [
      Math.cos(turn) * example[i]! + Math.sin(turn) * example[i + 2]!,
      example[i + 1]!,
      Math.cos(turn) * example[i + 2]! - Math.sin(turn) * example[i]!,
    ];
    const differences = points.map(([i, weight]) => {
      const [x, y, z] = turned(i) as [number, number, number];
      return { weight, x: query[i]! - x, y: query[i + 1]! - y, z: query[i + 2]! - z };
    });
    const mean = (of: "x" | "z") => differences.reduce((sum, one) => sum + one.weight * one[of], 0) / total;
    const [x, z] = [mean("x"), mean("z")];
    return differences.reduce((sum, d) => sum + d.weight * ((d.x - x) ** 2 + d.y ** 2 + (d.z - z) ** 2), 0) / total;
  };
  let least = Number.POSITIVE_INFINITY;
  for (let step = 0; step < 3600; step++) least = Math.min(least, at((step * Math.PI) / 1800));
  expect(distanceOf(found, 0)).toBeCloseTo(Math.sqrt(least), 5);
  const { heights, ground, turn } = align(query, pose, proportions);
  expect(Math.sqrt(heights + ground)).toBeCloseTo(Math.sqrt(least), 5);
  expect(at(turn)).toBeCloseTo(heights + ground, 8);
});

test("neighbours stand in the order in which the engine finds them", async () => {
  const found = await foundOf(engine, PRESET);
  const { rows, distances } = await engine.neighbours(lookOf(PRESET), 30, { query: changeOf(PRESET) });
  expect(Array.from(found.order.subarray(0, 30), (at) => found.firstRow + at)).toEqual([...rows]);
  for (const [i, distance] of distances.entries()) expect(distanceOf(found, i)).toBeCloseTo(distance, 6);
});

test("A is passed by one K alone", async () => {
  const passing: number[] = [];
  for (let k = 1; k <= 60; k++) if ((await result("A", { k })).result === "pass") passing.push(k);
  expect(passing).toEqual([22]);
  expect(await result("A", { k: 20 })).toEqual({ result: "near", way: "more" });
  expect(await result("A", { k: 23 })).toEqual({ result: "near", way: "less" });
  expect(await result("A", { k: 40 })).toEqual({ result: "no" });
  expect(await result("A", { k: 22, window: "9" })).toEqual({ result: "near", way: "other" });
  expect((await result("A", { k: 22, heading: 90, x: 1 })).result).toBe("pass");
});

test("A refuses squares", async () => {
  const refused: number[] = [];
  for (let k = 1; k <= 60; k++) if ((await result("A", { k })).result === "refuse") refused.push(k);
  expect(refused).toHaveLength(1);
  const text = await TEXTS.en.lessons.near!();
  const measure = await measureNear(engine, { ...PRESET, k: refused[0]! });
  expect(text.exercises.A!.refuse(saidIn("en", measure))).toMatch(
    /^You compared D, which is squared: with K \d+, D doubles/,
  );
});

test("B wants a move, and then nothing", async () => {
  const { change } = await measureNear(engine, { ...PRESET, heading: -90, z: -0.6 });
  expect(Number(change)).toBeLessThan(0.01);
  expect(await result("B", { guess: 0 })).toEqual({ result: "near", way: "further" });
  expect(await result("B", { heading: 90, x: 0.3, guess: 0 })).toEqual({ result: "near", way: "further" });
  expect(await result("B", { heading: -90, z: -0.6 })).toEqual({ result: "near", way: "none" });
  expect(await result("B", { heading: -90, z: -0.6, guess: 0.05 })).toEqual({ result: "pass" });
  expect(await result("B", { heading: -90, z: -0.6, guess: 600 })).toEqual({ result: "refuse" });
  const bent: NearState["turned"] = [{ joint: "left_upper_arm", by: [0, 0, 30] }];
  expect(await result("B", { heading: -90, z: -0.6, guess: 0, turned: bent })).toEqual({
    result: "near",
    way: "other",
  });
});

test("C: one frame has no direction, and five have", async () => {
  expect(await result("C", {})).toEqual({ result: "near", way: "forward" });
  expect(await result("C", { reversed: true })).toEqual({ result: "refuse" });
  expect(await result("C", { reversed: true, window: "5" })).toEqual({ result: "pass" });
  expect(await result("C", { reversed: true, window: "15" })).toEqual({ result: "near", way: "shorter" });
  const { backwards1, backwards5 } = await measureNear(engine, PRESET);
  expect(backwards1).toBeCloseTo(1, 6);
  expect(backwards5).toBeGreaterThan(8);
});
