import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import type { JointPath } from "../client/learn/protocol";
import {
  cadenceOf,
  farthest,
  farthestDeviations,
  framesOf,
  jerkOf,
  measureChain,
  pathOf,
  STATES,
  WALK_HZ,
} from "../element/figure/chain/chain_measure";
import { CHAIN_FIELDS, type ChainState } from "../element/figure/chain/chain_state";
import { serveLearnPackage } from "../engine/learn/wasm";
import { DEGREES, POSE_FLOATS } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { chain } from "./chain";
import { judge } from "./lesson";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(CHAIN_FIELDS);
const exercise = (id: string) => chain.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<ChainState>) =>
  judge(exercise(id), await measureChain(engine, { ...readHash(CHAIN_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: a firmer promise about the change of change is smoother", async () => {
  const { answer, measure } = await chain.bet.reveal(engine);
  expect(answer).toBe("smoother");
  expect(Number(measure.toes)).toBeLessThan(0.6);
});

test("measures of a curve are those of its definition", () => {
  const path: JointPath = {
    c: Float32Array.of(0, 0, 0, 6, 0),
    mean: Float32Array.of(0, 1, 0, 2, 0),
    deviation: Float32Array.of(1, 1, 1, 2, 1),
    state: Uint8Array.of(0, 1, 2, 3, 4),
    side: new Uint8Array(5),
    durations: Float32Array.of(1, 2, 3, 4, 5, 6, 7, 8, 9, 10),
  };
  expect(farthest(path)).toBeCloseTo(4 * DEGREES, 5);
  // Deviations of the model: with the factor 4 the ones that are shown are twice as large.
  expect(farthestDeviations(path, 4)).toBeCloseTo(4, 6);
  // Third differences 6 and −18.
  expect(jerkOf(path)).toBeCloseTo(12 * DEGREES, 4);
  expect(framesOf(path)).toEqual([15, 40]);
  expect(cadenceOf(path)).toBeCloseTo((2 * 60 * 30) / 55, 6);
});

test("a step has five states in order, and frames as many as they last", async () => {
  const path = await pathOf(engine, PRESET);
  const [left, right] = framesOf(path);
  expect(Math.abs(path.c.length - left - right)).toBeLessThanOrEqual(1);
  expect(new Set(path.state).size).toBe(STATES);
  path.state.forEach((state, i) => {
    if (i > 0 && path.side[i] === path.side[i - 1]) expect(state).toBeGreaterThanOrEqual(path.state[i - 1]!);
  });
});

test("no nearby curve keeps the promises about poses better when they alone are firm", async () => {
  const [firm, plain] = await Promise.all([0.001, 1].map((pose) => pathOf(engine, { ...PRESET, pose })));
  const misfit = ({ c, mean }: JointPath, by = 0) => c.reduce((sum, value, i) => sum + (value + by - mean[i]!) ** 2, 0);
  expect(misfit(firm!)).toBeLessThan(0.2 * misfit(plain!));
  for (const by of [-0.05, 0.05]) expect(misfit(firm!)).toBeLessThan(misfit(firm!, by));
});

test("ρ makes each state longer by its variance", async () => {
  const [zero, one, two] = await Promise.all(
    [0, 1, 2].map((rho) => pathOf(engine, { ...PRESET, left: rho, right: rho })),
  );
  zero!.durations.forEach((frames, i) => {
    const variance = one!.durations[i]! - frames;
    expect(variance).toBeGreaterThan(0);
    expect(two!.durations[i]).toBeCloseTo(frames + 2 * variance, 3);
  });
});

test("the walk has the model's rate, and goes forwards", async () => {
  const { poses, rateHz } = await engine.walk({ neutral: 1 }, 90);
  expect(rateHz).toBe(WALK_HZ);
  expect(poses).toHaveLength(90 * POSE_FLOATS);
  expect(poses[89 * POSE_FLOATS + 2]! - poses[2]!).toBeGreaterThan(1.5);
});

test("A is passed by a firm promise about poses, or by loose ones about changes", async () => {
  expect((await result("A", {})).result).toBe("no");
  expect(await result("A", { pose: 0.001 })).toEqual({ result: "pass" });
  expect(await result("A", { velocity: 1000, acceleration: 1000 })).toEqual({ result: "pass" });
  expect(await result("A", { pose: 0.003 })).toEqual({ result: "near", way: "further" });
  expect(await result("A", { pose: 10 })).toEqual({ result: "refuse" });
  expect(await result("A", { acceleration: 0.1 })).toEqual({ result: "refuse" });
  expect(await result("A", { pose: 0.001, share: 1 })).toEqual({ result: "near", way: "other" });
});

test("B is passed by a stretch of σ″², and refuses one that is too firm", async () => {
  const passing: number[] = [];
  for (const acceleration of [1, 0.3, 0.1, 0.08, 0.07, 0.06, 0.05, 0.03, 0.01])
    if ((await result("B", { acceleration })).result === "pass") passing.push(acceleration);
  expect(passing.length).toBeGreaterThan(1);
  expect(Math.max(...passing)).toBeLessThan(0.1);
  expect(Math.min(...passing)).toBeGreaterThan(0.03);
  expect(await result("B", { acceleration: 0.1 })).toEqual({ result: "near", way: "rough" });
  expect(await result("B", { acceleration: 0.01 })).toEqual({ result: "refuse" });
  expect(await result("B", { pose: 0.1 })).toEqual({ result: "no" });
  expect(await result("B", { acceleration: 0.06, joint: "right_toes" })).toEqual({ result: "near", way: "other" });
});

test("C is passed by longer states, and refuses a negative ρ", async () => {
  expect((await result("C", {})).result).toBe("no");
  expect(await result("C", { left: 1.1, right: 0.95 })).toEqual({ result: "pass" });
  expect(await result("C", { left: 0.8, right: 0.8 })).toEqual({ result: "near", way: "longer" });
  expect(await result("C", { left: 1.3, right: 1.2 })).toEqual({ result: "near", way: "shorter" });
  expect(await result("C", { left: -1, right: -1 })).toEqual({ result: "refuse" });
  const text = await TEXTS.en.lessons.chain!();
  const said = saidIn("en", await measureChain(engine, { ...PRESET, left: -1, right: -1 }));
  expect(text.exercises.C!.refuse(said)).toMatch(/^A negative ρ makes states shorter: 127\.32 steps a minute\./);
});
