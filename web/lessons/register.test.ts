import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { measureWarp } from "../element/figure/warp/warp_measure";
import { WARP_FIELDS, type WarpState } from "../element/figure/warp/warp_state";
import { costAt, costRatio, feetAt, msOff, ownPath, type Warping, warpingOf } from "../element/figure/warp/warping";
import { serveLearnPackage } from "../engine/learn/wasm";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { register } from "./register";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(WARP_FIELDS);
const exercise = (id: string) => register.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<WarpState>) =>
  judge(exercise(id), await measureWarp(engine, { ...readHash(WARP_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: the straight line is nearer to the truth than the cheapest path", async () => {
  const { answer, measure } = await register.bet.reveal(engine);
  expect(answer).toBe("straight");
  expect(Number(measure.dtw)).toBeGreaterThan(4 * Number(measure.linear));
});

/** The least cost of all paths by the recurrence of the lesson, for every pair of frames from the ends. */
function leastCost({ costs, neutral: { frames: n }, styled: { frames: m } }: Warping): number {
  const c = (i: number, j: number) => (i < 0 || j < 0 ? Number.POSITIVE_INFINITY : costs[i * m + j]!);
  const total = new Map<string, number>();
  const C = (i: number, j: number): number => {
    if (i === 0 && j === 0) return c(0, 0);
    if (i < 0 || j < 0) return Number.POSITIVE_INFINITY;
    const key = `${i} ${j}`;
    const known = total.get(key);
    if (known !== undefined) return known;
    let least = C(i - 1, j - 1);
    for (const s of [2, 3]) {
      let [across, up] = [C(i - s, j - 1), C(i - 1, j - s)];
      for (let r = 1; r < s; r++) {
        across += c(i - r, j);
        up += c(i, j - r);
      }
      least = Math.min(least, across, up);
    }
    total.set(key, c(i, j) + least);
    return c(i, j) + least;
  };
  return C(n - 1, m - 1);
}

test("DTW's path costs what the recurrence says is the least", async () => {
  const warping = await warpingOf(engine, "old");
  const { dtw } = warping.paths;
  let cost = costAt(warping, 0, 0);
  for (let i = 1; i < dtw.length; i++) {
    // A path that is steep passes several frames of the style's in one of the neutral step's.
    for (let j = Math.round(dtw[i - 1]!) + 1; j <= Math.round(dtw[i]!); j++) cost += costAt(warping, i, j);
    if (Math.round(dtw[i]!) === Math.round(dtw[i - 1]!)) cost += costAt(warping, i, dtw[i]!);
  }
  const least = leastCost(warping);
  expect(least).toBeGreaterThan(0);
  // Whole frames are rounded from the engine's path between them.
  expect(cost / least).toBeGreaterThan(0.98);
  expect(cost / least).toBeLessThan(1.1);
});

test("the straight path is a straight line, and the distance from the truth a mean", async () => {
  const warping = await warpingOf(engine, "old");
  const { linear, exact } = warping.paths;
  linear.forEach((at, i) => {
    if (Math.abs(at - (i * (warping.styled.frames - 1)) / (linear.length - 1)) > 1e-3) throw new Error(`frame ${i}`);
  });
  let sum = 0;
  for (let i = 0; i < linear.length; i++) sum += Math.abs(linear[i]! - exact[i]!);
  expect(msOff(warping, linear)).toBeCloseTo((1000 * sum) / linear.length / 60, 6);
  expect(costRatio(warping, ownPath(warping, PRESET.anchors))).toBeCloseTo(costRatio(warping, linear), 2);
});

test("A wants a cheap path, not the true one", async () => {
  expect((await result("A", {})).result).toBe("no");
  const warping = await warpingOf(engine, "old");
  const along = (path: Float32Array, shares: readonly number[]) =>
    shares.map((x) => ({ x, y: path[Math.round(x * (path.length - 1))]! / (warping.styled.frames - 1) }));
  const { dtw, exact } = warping.paths;
  expect(await result("A", { anchors: along(exact, [0.25, 0.5, 0.75]) })).toEqual({ result: "refuse" });
  const near = await result("A", { anchors: along(dtw, [0.2, 0.45, 0.8]) });
  expect(["pass", "near"]).toContain(near.result);
  expect(await result("A", { style: "proud" })).toEqual({ result: "near", way: "other" });
  const text = await TEXTS.en.lessons.register!();
  expect(text.exercises.A!.no(saidIn("en", await measureWarp(engine, PRESET)))).toMatch(
    /^1\.73 times the cost\. Dearest: from \d+ to \d+ ms\.$/,
  );
});

test("B is passed where DTW mends the feet", async () => {
  const warping = await warpingOf(engine, "old");
  const { linear, dtw } = warping.paths;
  const passing: number[] = [];
  for (let at = 0; at < warping.neutral.frames; at++) {
    const same = (path: Float32Array) =>
      String(feetAt(warping.neutral, at)) === String(feetAt(warping.styled, path[at]!));
    const { result: found } = await result("B", { at });
    expect(found === "pass").toBe(!same(linear) && same(dtw));
    if (found === "pass") passing.push(at);
  }
  expect(passing.length).toBeGreaterThan(2);
  expect(passing.length).toBeLessThan(12);
  expect(await result("B", { at: passing[0]! - 2 })).toEqual({ result: "near", way: "later" });
  expect(await result("B", { at: 30 })).toEqual({ result: "no" });
  expect(await result("B", { at: passing[0]!, style: "sexy" })).toEqual({ result: "near", way: "other" });
});

test("B refuses an instant at which feet differ under both", async () => {
  const refused: number[] = [];
  for (let at = 0; at < 65; at++) if ((await result("B", { at })).result === "refuse") refused.push(at);
  expect(refused.length).toBeGreaterThan(0);
});
