import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import {
  draggedOf,
  errorsOf,
  keyedOf,
  measureMap,
  passOf,
  samplesOf,
  worstStretch,
} from "../element/figure/map/map_measure";
import { BLUR, MAP_FIELDS, type MapState, sharingOf } from "../element/figure/map/map_state";
import { serveLearnPackage } from "../engine/learn/wasm";
import { POSE_FLOATS } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { map } from "./map";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(MAP_FIELDS);
const exercise = (id: string) => map.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<MapState>) =>
  judge(exercise(id), await measureMap(engine, { ...readHash(MAP_FIELDS, exercise(id).start("")), ...patch }));
const frames = async () => (await samplesOf(engine)).values.length / 2;
const mean = (values: Float32Array) => values.reduce((sum, value) => sum + value, 0) / values.length;

test("the bet: as printed, learning diverges", async () => {
  const { answer, measure } = await map.bet.reveal(engine);
  expect(answer).toBe("diverges");
  expect(Number(measure.right)).toBeLessThan(0.1);
  expect(Number(measure.printed)).toBeGreaterThan(1);
});

test("an update shares the sample, and moves shares and centres as the equations say", async () => {
  const [before, after] = [await engine.somn(40, false), await engine.somn(41, false)];
  expect(after.updates).toBe(41);
  expect(after.r.reduce((sum, r) => sum + r, 0)).toBeCloseTo(1, 5);
  const { values } = await samplesOf(engine);
  after.r.forEach((r, i) => {
    expect(after.weights[i]).toBeCloseTo(before.weights[i]! + 0.2 * after.delta * (r - before.weights[i]!), 4);
    for (const axis of [0, 1]) {
      const [m, next] = [before.centres[2 * i + axis]!, after.centres[2 * i + axis]!];
      const u = values[2 * after.sample + axis]!;
      expect(Math.abs(next - (m + after.delta * r * (u - m)))).toBeLessThan(0.01 * Math.abs(u - m) + 1e-3);
    }
  });
});

test("learning goes on from where it is, or begins again, with the same result", async () => {
  const direct = await engine.somn(150, false);
  await engine.somn(20, false);
  const again = await engine.somn(150, false);
  expect(again.centres).toEqual(direct.centres);
  expect((await engine.somn(20, false)).sigma).toBeGreaterThan(direct.sigma);
});

test("the width narrows and the rate falls from pass to pass", async () => {
  const n = await frames();
  const [first, last] = [await engine.somn(n, false), await engine.somn(20 * n, false)];
  expect(first.sigma / last.sigma).toBeGreaterThan(4);
  expect(first.delta / last.delta).toBeGreaterThan(20);
  expect(passOf(n - 1, n)).toBe(0);
  expect(passOf(20 * n, n)).toBe(20);
});

test("the greatest change is that of poses that are asked for one by one", async () => {
  const { values } = await samplesOf(engine);
  const sharing = sharingOf({ temperature: 2 });
  expect(sharing.blur).toBe(BLUR);
  // The first leg of the first drag, by the same fixed sequence.
  let seed = 1;
  const next = () => {
    seed = (seed * 1_103_515_245 + 12_345) % 2_147_483_648;
    const frame = Math.floor((seed / 2_147_483_648) * (values.length / 2));
    return [values[2 * frame]!, values[2 * frame + 1]!] as const;
  };
  const [from, to] = [next(), next()];
  let greatest = 0;
  let before: Float32Array | undefined;
  for (let i = 0; i < 45; i++) {
    const at = [0, 1].map((axis) => from[axis]! + (i / 45) * (to[axis]! - from[axis]!));
    const { pose } = await engine.stylePose(at, sharing);
    if (before)
      for (let joint = 3; joint < POSE_FLOATS; joint += 4) {
        let cosine = 0;
        for (let k = joint; k < joint + 4; k++) cosine += pose[k]! * before[k]!;
        greatest = Math.max(greatest, (360 / Math.PI) * Math.acos(Math.min(1, Math.abs(cosine))));
      }
    before = pose;
  }
  const { change } = await draggedOf(engine, 2);
  expect(greatest).toBeGreaterThan(0.5);
  expect(change).toBeGreaterThanOrEqual(greatest);
});

test("keys are where the variables are recorded, and the worst stretch is between two of them", async () => {
  const { values, cycle } = await samplesOf(engine);
  const keys = [2, 12, 23];
  const keyed = await keyedOf(engine, keys);
  for (const key of keys)
    for (const axis of [0, 1])
      expect(keyed.values[2 * key + axis]).toBeCloseTo(values[2 * (cycle.first + key) + axis]!, 2);
  expect(worstStretch(Float32Array.of(1, 0, 0, 5, 0, 0), [2, 4])).toEqual({ from: 2, to: 4, error: 5 });
  expect(worstStretch(Float32Array.of(6, 0, 0, 5, 0, 0), [2, 4])).toEqual({ from: 4, to: 2, error: 6 });
});

test("A is passed by one pass alone", async () => {
  const n = await frames();
  const errors = await errorsOf(engine);
  const passing: number[] = [];
  for (let pass = 0; pass <= errors.length; pass++)
    if ((await result("A", { updates: pass * n })).result === "pass") passing.push(pass);
  expect(passing).toHaveLength(1);
  const [first] = passing as [number];
  expect(errors[first - 1]! / errors.at(-1)!).toBeLessThan(1.05);
  expect(errors[first - 2]! / errors.at(-1)!).toBeGreaterThan(1.05);
  expect(await result("A", { updates: (first - 1) * n })).toEqual({ result: "near", way: "later" });
  expect(await result("A", { updates: (first + 3) * n })).toEqual({ result: "near", way: "earlier" });
  expect(await result("A", { updates: errors.length * n })).toEqual({ result: "refuse" });
  expect((await result("A", {})).result).toBe("no");
});

test("B is passed by a stretch of T, and refuses a hard change", async () => {
  const passing: number[] = [];
  for (const temperature of [1, 2, 3, 3.5, 4, 4.5, 5, 5.5, 6, 8])
    if ((await result("B", { temperature })).result === "pass") passing.push(temperature);
  expect(passing).toEqual([4, 4.5, 5]);
  expect(await result("B", {})).toEqual({ result: "refuse" });
  expect(await result("B", { temperature: 3.5 })).toEqual({ result: "near", way: "softer" });
  expect(await result("B", { temperature: 6 })).toEqual({ result: "near", way: "harder" });
  expect(await result("B", { temperature: 16 })).toEqual({ result: "no" });
});

test("C wants three keys in the right places, and says where it is worst", async () => {
  expect(await result("C", {})).toEqual({ result: "refuse" });
  const { cycle } = await samplesOf(engine);
  const even = (first: number, count: number) =>
    Array.from({ length: count }, (_, i) => Math.round(first + (i * cycle.frames) / count));
  const found: Record<string, number> = {};
  for (let first = 0; first < 10; first++) {
    const { result: how } = await result("C", { keys: even(first, 3) });
    found[how] = (found[how] ?? 0) + 1;
    const error = mean((await keyedOf(engine, even(first, 3))).errors);
    expect(how === "pass").toBe(error <= 2);
  }
  expect(found.pass).toBeGreaterThan(1);
  expect(found.near).toBeGreaterThan(1);
  expect(await result("C", { keys: even(0, 4) })).toEqual({ result: "near", way: "fewer" });
  const text = await TEXTS.en.lessons.map!();
  expect(text.exercises.C!.refuse(saidIn("en", await measureMap(engine, PRESET)))).toMatch(
    /^2 keys are too few: from key \d+ ms to \d+ ms it is off by up to \d+\.\d\d°\.$/,
  );
});
