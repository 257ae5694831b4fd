import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { DEFAULT_OPTIONS } from "../client/protocol";
import { serveLearnPackage } from "../engine/learn/wasm";
import { biasOf, elevation, leastReach, measureBias, survives } from "../figures/bias/bias_measure";
import { BIAS_FIELDS, type BiasState, lookOf, raisedInput, SETTINGS } from "../figures/bias/bias_state";
import { DEGREES, exp, JOINT, log, multiply, POSE_FLOATS, quaternionAt, restPose } from "../humanoid";
import { inverse } from "../humanoid/rotations";
import { readHash } from "../link/hash";
import { bias } from "./bias";
import { judge } from "./lesson";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const exercise = (id: string) => bias.exercises.find((one) => one.id === id)!;
const stateOf = (id: string, patch: Partial<BiasState>): BiasState => ({
  ...readHash(BIAS_FIELDS, exercise(id).start("")),
  ...patch,
});
const result = async (id: string, patch: Partial<BiasState>) =>
  judge(exercise(id), await measureBias(engine, stateOf(id, patch)));
const said = async (language: "en" | "de", id: string, patch: Partial<BiasState>) =>
  saidIn(language, await measureBias(engine, stateOf(id, patch)), bias.decimals);

test("the bet: without ρ next to nothing of the raise survives", async () => {
  const { answer, measure } = await bias.bet.reveal(engine);
  expect(answer).toBe("little");
  expect(Math.abs(Number(measure.share))).toBeLessThan(0.05);
  expect(Number(measure.usual)).toBeGreaterThan(0.3);
});

test("x is the angle of the raised arm from its mean, and Δx is what of it is outside μ ± κσ", async () => {
  const state = stateOf("A", { keep: 0.7 });
  const { poses, means } = await engine.motion({ name: state.motion });
  const arm = JOINT.right_upper_arm;
  const local = quaternionAt(poses.subarray(state.at * POSE_FLOATS + 3), arm);
  const raised = multiply(exp([-state.raise / DEGREES, 0, 0]), local);
  const x = log(multiply(inverse(quaternionAt(means, arm)), raised))[1] * DEGREES;
  const band = await biasOf(engine, state);
  expect(band.x).toBeCloseTo(x, 2);
  const reach = state.reach * band.deviation;
  const inside = Math.min(band.mean + reach, Math.max(band.mean - reach, x));
  expect(band.bias).toBeCloseTo(x - inside, 2);
  expect(band.bias).toBeGreaterThan(20);
  const later = await biasOf(engine, { ...state, at: state.at + 15 });
  expect(Math.abs(later.x - x), "mutation: another frame").toBeGreaterThan(2);
  const wider = await biasOf(engine, { ...state, reach: 1.5 * state.reach });
  expect(Math.abs(wider.bias - band.bias), "mutation: another κ").toBeGreaterThan(1);
});

test("the mean and the deviation are those of the neighbours, by their weights", async () => {
  const fit = await engine.fit(lookOf(stateOf("B", {})), SETTINGS);
  const band = await biasOf(engine, stateOf("B", {}));
  const total = fit.weights.reduce((sum, weight) => sum + weight, 0);
  const mean = fit.x.reduce((sum, x, i) => sum + fit.weights[i]! * x, 0) / total;
  expect(band.mean).toBeCloseTo(mean * DEGREES, 2);
  const unweighted = fit.x.reduce((sum, x) => sum + x, 0) / fit.x.length;
  expect(Math.abs(band.mean - unweighted * DEGREES), "mutation: all weights equal").toBeGreaterThan(0.02);
  const square = fit.x.reduce((sum, x, i) => sum + fit.weights[i]! * (x - mean) ** 2, 0) / total;
  const deviation = Math.max(Math.sqrt(square), 0.05 * fit.globalDeviation, 0.005) * DEGREES;
  expect(band.deviation).toBeCloseTo(deviation, 2);
  expect(leastReach(band)).toBeCloseTo(Math.abs(band.x - mean * DEGREES) / deviation, 1);
  expect(leastReach(band)).toBeCloseTo(Math.abs(band.x - band.mean) / band.deviation, 6);
});

test("the output is what the line says and ρΔx", async () => {
  const [none, half] = await Promise.all([0, 0.5].map((keep) => biasOf(engine, stateOf("A", { keep }))));
  expect(none!.returned).toBe(0);
  expect(none!.y).toBe(none!.line);
  expect(half!.y - half!.line).toBeCloseTo(0.5 * half!.bias, 9);
});

test("an arm of the T-pose is a quarter turn above straight down", async () => {
  const { proportions } = await engine.motion({ name: "neutral walk" });
  expect(elevation(restPose(), proportions)).toBeCloseTo(90, 0);
});

test("the share that survives is that of poses which are styled frame by frame", async () => {
  const state = stateOf("A", { keep: 0.7 });
  const { proportions } = await engine.motion({ name: state.motion });
  const frames = [100, 300, 500, 700];
  const meanOf = async (raise: number) => {
    const poses = await Promise.all(frames.map((at) => engine.styled(lookOf({ ...state, raise, at }))));
    return poses.reduce((sum, { pose }) => sum + elevation(pose, proportions), 0) / frames.length;
  };
  const given = async (raise: number) => {
    const { poses } = await engine.motion(raisedInput({ motion: state.motion, raise }));
    const picked = frames.map((at) => elevation(poses.subarray(at * POSE_FLOATS, (at + 1) * POSE_FLOATS), proportions));
    return picked.reduce((sum, one) => sum + one, 0) / frames.length;
  };
  const share = ((await meanOf(60)) - (await meanOf(0))) / ((await given(60)) - (await given(0)));
  expect(await survives(engine, state)).toBeCloseTo(share, 1);
  expect(Math.abs((await survives(engine, { ...state, keep: 0.3 })) - share), "mutation: another ρ").toBeGreaterThan(
    0.2,
  );
});

test("A is passed by a narrow stretch of ρ, above the engine's own, and one half is refused", async () => {
  for (const keep of [0.84, 0.87]) expect(await result("A", { keep })).toEqual({ result: "pass" });
  expect(await result("A", { keep: 0.5 })).toEqual({ result: "refuse" });
  expect(await result("A", { keep: 0.82 })).toEqual({ result: "near", way: "more" });
  expect(await result("A", { keep: 0.9 })).toEqual({ result: "near", way: "less" });
  expect(await result("A", { keep: DEFAULT_OPTIONS.rho })).toEqual({ result: "no" });
  for (const patch of [{ raise: 30 }, { reach: 4 }, { style: "old" }, { motion: "neutral run" }] as const)
    expect(await result("A", { keep: 0.86, ...patch })).toEqual({ result: "near", way: "other" });
  expect(await result("A", { keep: 1 })).toEqual({ result: "no" });
  const text = { en: await TEXTS.en.lessons.bias!(), de: await TEXTS.de.lessons.bias!() };
  expect(text.en.exercises.A!.refuse(await said("en", "A", { keep: 0.5 }))).toMatch(
    /^ρ is a share .* 0\.50, 0\.\d\d survives\.$/,
  );
  expect(text.de.exercises.A!.refuse(await said("de", "A", { keep: 0.5 }))).toMatch(/^ρ ist ein Anteil .* 0,\d\d\.$/);
});

test("B is passed where the band just reaches the input", async () => {
  const least = leastReach(await biasOf(engine, stateOf("B", {})));
  expect(least).toBeGreaterThan(DEFAULT_OPTIONS.kappa + 0.5);
  const tenth = Math.ceil(least * 10) / 10;
  expect(await result("B", { reach: tenth })).toEqual({ result: "pass" });
  expect(await result("B", { reach: tenth + 0.2 })).toEqual({ result: "pass" });
  expect(await result("B", { reach: tenth + 0.4 })).toEqual({ result: "near", way: "less" });
  expect(await result("B", { reach: tenth + 0.7 })).toEqual({ result: "refuse" });
  expect(await result("B", { reach: tenth - 0.2 })).toEqual({ result: "near", way: "more" });
  expect(await result("B", { reach: 1 })).toEqual({ result: "no" });
  for (const patch of [{ at: 200 }, { raise: 9 }, { style: "old" }, { motion: "neutral run" }] as const)
    expect(await result("B", { reach: tenth, ...patch })).toEqual({ result: "near", way: "other" });
  const text = { en: await TEXTS.en.lessons.bias!(), de: await TEXTS.de.lessons.bias!() };
  expect(text.en.exercises.B!.refuse(await said("en", "B", { reach: 12 }))).toMatch(
    /^The input is inside the band, but κ 12\.0 is larger than necessary/,
  );
  expect(text.de.exercises.B!.refuse(await said("de", "B", { reach: 12 }))).toMatch(
    /^Die Eingabe liegt im Band, aber κ 12,0/,
  );
});

test("C wants what is outside the band, and refuses a share of all of x with its sentence", async () => {
  const { returned, keep, x, mean } = await measureBias(engine, stateOf("C", {}));
  const right = Number(Number(returned).toFixed(1));
  expect(await result("C", { guess: right })).toEqual({ result: "pass" });
  expect(await result("C", { guess: right + 0.8 })).toEqual({ result: "near", way: "less" });
  expect(await result("C", { guess: right - 0.8 })).toEqual({ result: "near", way: "more" });
  expect(await result("C", {})).toEqual({ result: "near", way: "none" });
  const fromMean = Number(keep) * (Number(x) - Number(mean));
  expect(await result("C", { guess: fromMean })).toEqual({ result: "near", way: "edge" });
  const all = Number(keep) * Number(x);
  expect(Math.abs(all - Number(returned)), "the mistake gives another number").toBeGreaterThan(2);
  expect(await result("C", { guess: all })).toEqual({ result: "refuse" });
  expect(await result("C", { guess: 0 })).toEqual({ result: "no" });
  // Other settings that would make it trivial: nothing is outside the band, or nothing returns.
  for (const patch of [{ reach: 16 }, { keep: 0 }, { raise: 0 }, { at: 200 }, { style: "old" }] as const)
    expect(await result("C", { guess: 0, ...patch }), JSON.stringify(patch)).toEqual({ result: "near", way: "other" });
  const text = { en: await TEXTS.en.lessons.bias!(), de: await TEXTS.de.lessons.bias!() };
  expect(text.en.exercises.C!.refuse(await said("en", "C", { guess: all }))).toMatch(
    /^You took all of x: −?\d+\.\d°\./,
  );
  expect(text.de.exercises.C!.refuse(await said("de", "C", { guess: all }))).toMatch(/^Du hast das ganze x genommen/);
});

test("floors of the deviation are the engine's", () => {
  const source = readFileSync(join(import.meta.dirname, "../../rust/strut-core/src/transfer/bias.rs"), "utf8");
  expect(source).toContain("const MIN_SHARE: f32 = 0.05;");
  expect(source).toContain("const MIN_DEVIATION: f32 = 0.005;");
});
