import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import type { Fit } from "../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../client/protocol";
import { serveLearnPackage } from "../engine/learn/wasm";
import { aboveMean, fitOf, LAMBDAS, measureLine, sweepOf, termsOf } from "../figures/line/line_measure";
import { LINE_FIELDS, type LineState } from "../figures/line/line_state";
import { DEGREES, JOINT, log, multiply, POSE_FLOATS, quaternionAt } from "../humanoid";
import { inverse } from "../humanoid/rotations";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { line } from "./line";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const exercise = (id: string) => line.exercises.find((one) => one.id === id)!;
const stateOf = (id: string, patch: Partial<LineState>): LineState => ({
  ...readHash(LINE_FIELDS, exercise(id).start("")),
  ...patch,
});
const result = async (id: string, patch: Partial<LineState>) =>
  judge(exercise(id), await measureLine(engine, stateOf(id, patch)));
const said = async (language: "en" | "de", id: string, patch: Partial<LineState>) =>
  saidIn(language, await measureLine(engine, stateOf(id, patch)), line.decimals);

/** a, b and c of the examples of a fit by Gaussian elimination in double precision, with |b| ≤ 0.9. */
function dense({ x, xPrevious, y, yPrevious, weights, globalDeviation }: Fit, lambda: number) {
  const total = weights.reduce((sum, v) => sum + v, 0);
  const mean = (values: Float32Array) => values.reduce((sum, value, i) => sum + weights[i]! * value, 0) / total;
  const [before, outBefore, now, out] = [xPrevious, yPrevious, x, y].map(mean) as [number, number, number, number];
  const rows = Array.from(x, (value, i) => [xPrevious[i]! - before, yPrevious[i]! - outBefore, value - now]);
  const solved = (terms: readonly number[], targets: readonly number[]): number[] => {
    const system = terms.map((p) => [
      ...terms.map((q) => {
        const product = rows.reduce((sum, row, i) => sum + weights[i]! * row[p]! * row[q]!, 0);
        return product + (p === q ? lambda * total * globalDeviation ** 2 : 0);
      }),
      rows.reduce((sum, row, i) => sum + weights[i]! * row[p]! * targets[i]!, 0),
    ]);
    for (let i = 0; i < system.length; i++)
      for (let j = 0; j < system.length; j++) {
        if (i === j) continue;
        const factor = system[j]![i]! / system[i]![i]!;
        system[j] = system[j]!.map((value, k) => value - factor * system[i]![k]!);
      }
    return system.map((row, i) => row.at(-1)! / row[i]!);
  };
  const targets = Array.from(y, (value) => value - out);
  let [a, b, c] = solved([0, 1, 2], targets) as [number, number, number];
  if (Math.abs(b) > 0.9) {
    b = 0.9 * Math.sign(b);
    [a, c] = solved(
      [0, 2],
      targets.map((value, i) => value - b * rows[i]![1]!),
    ) as [number, number];
  }
  return { a, b, c, before, outBefore, now, out };
}

/** yₜ of a fit's examples, with Δx subtracted and a share of it added. */
function predictedBy(fit: Fit, lambda: number, outputBefore = fit.query[1]): number {
  const { a, b, c, before, outBefore, now, out } = dense(fit, lambda);
  const [xPrevious, , x] = fit.query;
  const returned = DEFAULT_OPTIONS.rho * fit.bias;
  const line =
    a * (xPrevious - fit.bias - before) + b * (outputBefore - returned - outBefore) + c * (x - fit.bias - now);
  return out + line + returned;
}

test("the bet: a single dot has no slope", async () => {
  expect((await line.bet.reveal(engine)).answer).toBe("zero");
});

/** The whole walk predicted by plain loops over the examples of each frame, compared with the recorded angry walk; degrees. */
test("the errors of a sweep are those of a dense solve in each frame, from the prediction's own past", async () => {
  const state = stateOf("A", {});
  const lambdas = [0.0018, 0.02, 0.3, 10];
  const swept = await sweepOf(engine, state, lambdas);
  const [{ means }, ideal] = await Promise.all([
    engine.motion({ name: state.motion }),
    engine.counterpart(state.motion, state.style),
  ]);
  const joint = JOINT[state.joint];
  const kneeAt = (frame: number) => {
    const local = quaternionAt(ideal!.poses.subarray(frame * POSE_FLOATS + 3), joint);
    return log(multiply(inverse(quaternionAt(means, joint)), local))[0];
  };
  const frames = ideal!.poses.length / POSE_FLOATS;
  const outputs = lambdas.map(() => kneeAt(1));
  const [squares, shifted] = [lambdas.map(() => 0), lambdas.map(() => 0)];
  const classes = new Set<number>();
  for (let at = 2; at < frames; at++) {
    const fit = await fitOf(engine, { ...state, at });
    classes.add(fit.class);
    lambdas.forEach((lambda, i) => {
      outputs[i] = predictedBy(fit, lambda, outputs[i]!);
      squares[i]! += (outputs[i]! - kneeAt(at)) ** 2;
      shifted[i]! += (outputs[i]! - kneeAt(Math.min(frames - 1, at + 3))) ** 2;
    });
  }
  const [errors, mutated] = [squares, shifted].map((sums) =>
    sums.map((sum) => DEGREES * Math.sqrt(sum / (frames - 2))),
  );
  errors!.forEach((error, i) => {
    // The sweep also includes the first two frames, whose windows are not filled yet.
    const begun = frames * swept[i]! ** 2 - (frames - 2) * error ** 2;
    expect(begun, `λ ${lambdas[i]}`).toBeGreaterThan(0);
    expect(begun, `λ ${lambdas[i]}`).toBeLessThan(200);
    expect(Math.abs(swept[i]! / swept[1]! - error / errors![1]!)).toBeLessThan(0.015);
    expect(Math.abs(swept[i]! / mutated![i]! - 1), "mutation: three frames later").toBeGreaterThan(0.5);
  });
  expect(Math.abs(swept[0]! / swept[1]! - errors![2]! / errors![1]!), "mutation: another λ").toBeGreaterThan(0.03);
  // So exercise A may be solved at any instant: the examples are of one class.
  expect(classes.size).toBe(1);
}, 180_000);

test("A is passed around one λ, and says which way, and what is wrong on either side", async () => {
  const passing: number[] = [];
  const results: string[] = [];
  for (let i = 0; i <= 40; i++) {
    const lambda = Number((10 ** (-4 + i / 8)).toFixed(4));
    const { result: is } = await result("A", { lambda });
    results.push(is);
    if (is === "pass") passing.push(lambda);
  }
  expect(passing.length).toBeGreaterThan(1);
  expect(Math.max(...passing) / Math.min(...passing), "one stretch, within one order of magnitude").toBeLessThan(10);
  expect(results.join()).toMatch(/^(refuse,)+(near,)+(pass,)+(near,)+(no,?)+$/);
  expect(await result("A", { lambda: 0.0035 })).toEqual({ result: "near", way: "more" });
  expect(await result("A", { lambda: 0.024 })).toEqual({ result: "near", way: "less" });
  expect(await result("A", { lambda: 0.0005 })).toEqual({ result: "refuse" });
  expect(await result("A", { lambda: 5 })).toEqual({ result: "no" });
  expect(await result("A", { lambda: 0.01, at: 500 }), "the error is that of the whole walk").toEqual({
    result: "pass",
  });
});

/** All values that the tasks fix, changed one by one. */
const OTHERS = [
  { joint: "head" },
  { axis: "y" },
  { style: "proud" },
  { motion: "neutral run" },
] as const satisfies readonly Partial<LineState>[];

test("what a task fixes must stay", async () => {
  const other = { result: "near", way: "other" };
  for (const patch of [...OTHERS, { style: "old" }, { k: 40 }, { noise: 3 }, { taper: true }] as const)
    expect(await result("A", { lambda: 0.01, ...patch }), JSON.stringify(patch)).toEqual(other);
  for (const patch of [...OTHERS, { style: "angry" }, { k: 10 }, { noise: 1 }, { taper: false }, { at: 161 }] as const)
    expect(await result("B", { lambda: 0.9, ...patch }), JSON.stringify(patch)).toEqual(other);
  for (const patch of [...OTHERS, { noise: 8 }, { taper: false }])
    expect(await result("C", { at: 63, k: 160, lambda: 0.0001, ...patch }), JSON.stringify(patch)).toEqual(other);
}, 120_000);

test("B is passed from the least λ to half as much again, and there is only one such λ", async () => {
  const least = Number((await measureLine(engine, stateOf("B", {}))).leastLambda);
  const fit = await fitOf(engine, stateOf("B", {}));
  const above = (lambda: number) => Math.abs((predictedBy(fit, lambda) - dense(fit, lambda).out) * DEGREES);
  for (let lambda = 0.0001; lambda <= 10; lambda *= 1.1) {
    const apart = Math.abs(lambda / least - 1) > 0.03;
    if (apart) expect(above(lambda) <= 0.1, `λ ${lambda}`).toBe(lambda > least);
  }
  expect(above(least)).toBeCloseTo(0.1, 2);
  expect(Math.abs(above(1.5 * least) - 0.1), "mutation: another λ").toBeGreaterThan(0.02);
  const times = async (factor: number) => result("B", { lambda: least * factor });
  expect(await times(1.4)).toEqual({ result: "pass" });
  expect(await times(2)).toEqual({ result: "near", way: "less" });
  expect(await times(4)).toEqual({ result: "refuse" });
  expect(await times(0.7)).toEqual({ result: "near", way: "more" });
  expect(await times(0.1)).toEqual({ result: "no" });
});

test("C needs another instant, a steep line and more than a dot", async () => {
  expect(await result("C", {})).toEqual({ result: "no" });
  expect(await result("C", { lambda: 5 })).toEqual({ result: "refuse" });
  expect(await result("C", { k: 1 })).toEqual({ result: "refuse" });
  expect(await result("C", { at: 63, k: 160, lambda: 0.01 })).toEqual({ result: "near", way: "close" });
  const state = stateOf("C", { at: 63, k: 160, lambda: 0.0001 });
  expect(await result("C", state)).toEqual({ result: "pass" });
  const [fit, later] = await Promise.all([fitOf(engine, state), fitOf(engine, { ...state, at: 73 })]);
  const above = (one: Fit) => (predictedBy(one, 0.0001) - dense(one, 0.0001).out) * DEGREES;
  expect(aboveMean(fit)).toBeCloseTo(above(fit), 1);
  expect(Math.abs(aboveMean(fit) - above(later)), "mutation: ten frames later").toBeGreaterThan(0.5);
});

test("the terms of a line sum to its prediction", async () => {
  for (const patch of [{}, { k: 160, lambda: 0.001, at: 63 }, { k: 2, at: 300 }]) {
    const fit = await fitOf(engine, stateOf("C", patch));
    const { a, b, c, d, returned } = termsOf(fit);
    expect(a + b + c + d + returned).toBeCloseTo(fit.predicted * DEGREES, 3);
    expect(c).toBeCloseTo(fit.beta[2] * (fit.query[2] - fit.bias) * DEGREES, 6);
  }
});

test("misconceptions are refused with their sentence, in both languages", async () => {
  const [en, de] = [await TEXTS.en.lessons.line!(), await TEXTS.de.lessons.line!()];
  const steep = { lambda: 0.0005 };
  expect(en.exercises.A!.refuse(await said("en", "A", steep))).toMatch(
    /^The line follows the noise of the 12 points.*1\.\d\d°.*1\.50°/,
  );
  expect(de.exercises.A!.refuse(await said("de", "A", steep))).toMatch(
    /^Die Gerade folgt dem Rauschen der 12 Punkte.*1,\d\d°.*1,50°/,
  );
  expect(en.exercises.A!.no(await said("en", "A", { lambda: 5 }))).toMatch(/^Only the mean is left.*1\.64°.*1\.50°/);
  expect(de.exercises.A!.no(await said("de", "A", { lambda: 5 }))).toMatch(/^Nur das Mittel ist übrig/);
  expect(en.exercises.A!.no(await said("en", "A", { lambda: 0.06, at: 300 }))).toMatch(
    /^Too much λ: the line is flatter/,
  );
  expect(de.exercises.A!.no(await said("de", "A", { lambda: 0.06, at: 300 }))).toMatch(
    /^Zu viel λ: Die Gerade ist flacher/,
  );
  expect(en.exercises.B!.refuse(await said("en", "B", { lambda: 5 }))).toMatch(
    /^Only the mean is left: λ 5\.0000 gives −0\.02°/,
  );
  expect(en.exercises.C!.refuse(await said("en", "C", { k: 1 }))).toMatch(
    /^Only the mean is left: 0\.00°\. A steep line/,
  );
  expect(en.exercises.C!.pass(await said("en", "C", { at: 63, k: 160, lambda: 0.0001 }))).toMatch(
    /with K 160 and λ 0\.0001\.$/,
  );
});

test("numbers of the text are the engine's", async () => {
  const source = readFileSync(join(import.meta.dirname, "../../rust/strut-core/src/transfer/regression.rs"), "utf8");
  expect(source).toContain("pub const MAX_FEEDBACK: f32 = 0.9;");
  expect(line.equation).toContain("0.9");
  const { k, lambda } = initialOf(LINE_FIELDS);
  expect({ k, lambda }).toEqual({ k: DEFAULT_OPTIONS.k, lambda: DEFAULT_OPTIONS.lambda });
  expect((await TEXTS.en.lessons.line!()).exercises.B!.task).toContain(`at ${k} neighbours`);
  expect(LAMBDAS).toHaveLength(25);
});

test("without examples to follow every ridge errs alike", async () => {
  const state = stateOf("A", { k: 1, noise: 0 });
  const [small, great] = await sweepOf(engine, state, [0.0001, 10]);
  expect(small).toBeCloseTo(great!, 5);
});

test("the sweep gives exercise A away, and waits for it", () => {
  expect(line.figures.find(({ kind }) => kind === "sweep")).toMatchObject({ after: "A" });
});
