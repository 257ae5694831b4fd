/** The lessons' engine on this thread, compared with computations of its numbers from their definitions. */
import { beforeAll, expect, test } from "vitest";
import { serveLearnPackage } from "../../engine/learn/wasm";
import { JOINT, POSE_FLOATS } from "../../humanoid";
import { createLearnTable } from "./learn_table";
import type { Fit, FitSettings, LearnEngine, Look } from "./protocol";

const LOOK: Look = { input: { name: "neutral walk" }, styles: { old: 1 }, frame: 160 };
const KNEE = 3 * JOINT.left_lower_leg;
const FIT: FitSettings = { dof: KNEE, k: 40, lambda: 0.1, noise: 0, taper: true };

let engine: LearnEngine;
beforeAll(() => {
  serveLearnPackage();
  engine = createLearnTable();
});

const sum = (values: Iterable<number>) => [...values].reduce((a, b) => a + b, 0);

/** β for xₜ₋₁, yₜ₋₁ and xₜ by Gaussian elimination of the normal equations; the feedback is far from its limit. */
function dense({ x, xPrevious, y, yPrevious, weights, globalDeviation }: Fit, lambda: number): number[] {
  const total = sum(weights);
  const centred = (values: Float32Array) => {
    const mean = sum(values.map((value, i) => value * weights[i]!)) / total;
    return values.map((value) => value - mean);
  };
  const columns = [xPrevious, yPrevious, x, y].map(centred);
  const product = (a: number, b: number) => sum(columns[a]!.map((value, i) => value * columns[b]![i]! * weights[i]!));
  const ridge = lambda * total * globalDeviation ** 2;
  const rows = [0, 1, 2].map((a) => [0, 1, 2, 3].map((b) => product(a, b) + (a === b ? ridge : 0)));
  for (const pivot of [0, 1, 2])
    for (const row of [0, 1, 2].filter((other) => other !== pivot)) {
      const factor = rows[row]![pivot]! / rows[pivot]![pivot]!;
      rows[row] = rows[row]!.map((value, i) => value - factor * rows[pivot]![i]!);
    }
  return rows.map((row, i) => row[3]! / row[i]!);
}

test("a fit is that of the normal equations, and its prediction that of its numbers", async () => {
  for (const lambda of [0.001, 0.1, 5]) {
    const fit = await engine.fit(LOOK, { ...FIT, lambda });
    dense(fit, lambda).forEach((beta, i) => {
      expect(fit.beta[i]).toBeCloseTo(beta, 3);
    });
    const { xPrevious, yPrevious, x, y } = fit.means;
    const terms = [xPrevious, yPrevious, x].map((mean, i) => fit.beta[i]! * (fit.query[i]! - mean));
    expect(fit.bias).toBe(0);
    expect(fit.predicted).toBeCloseTo(y + sum(terms), 5);
  }
});

test("the prediction of the nearest alone has no slope, and a great ridge leaves the mean", async () => {
  const one = await engine.fit(LOOK, { ...FIT, k: 1, taper: false });
  expect(one.beta).toEqual([0, 0, 0]);
  const mean = await engine.fit(LOOK, { ...FIT, lambda: 1e6 });
  expect(mean.predicted).toBeCloseTo(mean.means.y, 6);
});

test("weights follow from distances", async () => {
  const { weights, meanSquares } = await engine.classes({
    ...LOOK,
    input: { name: "neutral run, walk, jump and walk" },
    frame: 60,
  });
  const least = Math.min(...meanSquares);
  // δ, wider if the input is unknown: docs/methods/mar.md §7.
  const width = 0.35 * (3 - 2 / (1 + (least / 0.0025) ** 4));
  const raw = [...meanSquares].map((square) => Math.exp(-(square - least) / (width * least)));
  const kept = raw.map((weight) => (weight < 2e-5 ? 0 : weight));
  weights.forEach((weight, i) => {
    expect(weight).toBeCloseTo(kept[i]! / sum(kept), 5);
  });
  expect(kept.filter((weight) => weight > 0).length).toBeGreaterThan(3);
});

test("the nearest are those of the profile, and move with the query", async () => {
  const { class: of, firstRow, distances, query } = await engine.profile(LOOK, {});
  expect(query.length).toBe(POSE_FLOATS);
  const order = [...distances.keys()].filter((row) => !Number.isNaN(distances[row]!));
  order.sort((a, b) => distances[a]! - distances[b]!);
  const nearest = await engine.neighbours(LOOK, 22, { class: of });
  expect([...nearest.rows]).toEqual(order.slice(0, 22).map((row) => row + firstRow));
  expect(nearest.weights[0]).toBe(1);
  expect(nearest.weights[21]).toBe(0);
  const moved = { turns: [], heading: Math.PI / 2, x: 1, z: 0, reversed: false };
  const there = await engine.neighbours(LOOK, 22, { query: moved });
  there.distances.forEach((distance, i) => {
    expect(Math.abs(distance - nearest.distances[i]!)).toBeLessThan(1e-4);
  });
  const backwards = await engine.neighbours(LOOK, 1, { length: 15, query: { ...moved, reversed: true } });
  expect(backwards.distances[0]).toBeGreaterThan(10 * nearest.distances[0]!);
});

test("durations and contacts come out of their voices", async () => {
  const { distances, durations, kernel, weights, bandwidth, duration } = await engine.timing(LOOK, "old");
  expect(bandwidth).toBeCloseTo(sum(distances) / distances.length, 4);
  const nearest = Math.min(...distances);
  distances.forEach((distance, i) => {
    expect(kernel[i]).toBeCloseTo(Math.exp((nearest ** 2 - distance ** 2) / (2 * bandwidth ** 2)), 4);
  });
  const voices = kernel.map((g, i) => g * weights[i]!);
  expect(duration).toBeCloseTo(sum(voices.map((voice, i) => voice * durations[i]!)) / sum(voices), 6);
  const contacts = await engine.contacts(LOOK);
  for (const side of [0, 1]) {
    const own = (values: ArrayLike<number>) => contacts.rows.map((_, i) => values[2 * i + side]!);
    const [g, c] = [Float32Array.from(contacts.rows, (_, i) => contacts.voices[2 * i + side]!), own(contacts.contacts)];
    expect(contacts.votes[side]).toBeCloseTo(sum(g.map((voice, i) => voice * c[i]!)) / sum(g), 4);
  }
});

test("calls do not disturb each other, whatever came between", async () => {
  const alone = await engine.fit(LOOK, FIT);
  await engine.classes({ ...LOOK, frame: 300, options: { delta: 3 } });
  await engine.neighbours(LOOK, 5, { query: { turns: [], heading: 0, x: 0, z: 0, reversed: true } });
  await engine.timing({ ...LOOK, styles: { proud: 0.5, old: 0.5 } }, "proud");
  await engine.fit({ ...LOOK, input: { name: "neutral run" } }, FIT);
  expect(await engine.fit(LOOK, FIT)).toEqual(alone);
  for (let frame = 0; frame < 12; frame++)
    await engine.styled({ ...LOOK, input: { name: "neutral walk", turns: [{ joint: 6, by: [0, 0, frame / 10] }] } });
  expect(await engine.fit(LOOK, FIT)).toEqual(alone);
});

test("the ridge that is best is neither the least nor the greatest", async () => {
  const lambdas = [1e-4, 0.02, 1e6];
  const noisy = { dof: KNEE, k: 12, noise: (4 * Math.PI) / 180, taper: false };
  const [least, best, greatest] = await engine.sweep(LOOK, noisy, lambdas);
  expect(best).toBeLessThan(Math.min(least!, greatest!));
});

test("a take that is held out is not found", async () => {
  const look = (without: string[]): Look => ({ ...LOOK, input: { name: "walk-pace", without } });
  const left = await engine.neighbours(look([]), 1, {});
  const out = await engine.neighbours(look(["walk-pace"]), 1, {});
  expect(left.distances[0]).toBeLessThan(1e-3);
  expect(out.distances[0]).toBeGreaterThan(5 * left.distances[0]!);
});

test("cycles of an action are compared, and the warp of least cost is no dearer than others", async () => {
  const clips = await engine.clips("walk");
  const cycle = (style: string) => clips.find(({ name }) => name === `walk-pace_${style}`)!.cycles[2]!;
  const [a, b] = [cycle("neutral"), cycle("old")];
  const [dtw, linear] = [await engine.register("walk", a, b, "dtw"), await engine.register("walk", a, b, "linear")];
  const frames = b.last - b.first + 1;
  expect(dtw.costs.length).toBe((a.last - a.first + 1) * frames);
  const along = (warp: Float32Array) => sum(warp.map((at, i) => dtw.costs[i * frames + Math.round(at)]!));
  expect(along(dtw.warp)).toBeLessThan(along(linear.warp));
  const imw = await engine.register("walk", a, b, "imw");
  expect([imw.scale.length, imw.offset.length]).toEqual([dtw.warp.length, dtw.warp.length]);
});

test("what is not there is refused with a sentence", async () => {
  const refused = (call: Promise<unknown>, message: RegExp) =>
    expect(call).rejects.toMatchObject({ code: "bad-input", message: expect.stringMatching(message) });
  await refused(engine.motion({ name: "a stranger's walk" }), /stranger/);
  await refused(engine.fit(LOOK, { ...FIT, dof: 67 }), /degree of freedom 67/);
  await refused(engine.fit(LOOK, { ...FIT, k: 0 }), /K is 0/);
  await refused(engine.fit({ ...LOOK, styles: { grumpy: 1 } }, FIT), /no style 'grumpy'/);
  await refused(engine.timing(LOOK, "proud"), /'proud' has no weight/);
  await refused(
    engine.sweep({ ...LOOK, input: { name: "neutral walk", turns: [{ joint: 40, by: [0, 0, 0] }] } }, FIT, [1]),
    /joint 40/,
  );
  await refused(engine.rowPoses([1e7]), /row/);
  await refused(engine.clips("swim"), /action/);
  await refused(engine.styled({ ...LOOK, options: { k: -1 } }), /k/i);
});
