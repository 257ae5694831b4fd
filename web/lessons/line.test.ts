import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { aboveMean, fitOf, measureLine, sweepOf } from "../element/figure/line/line_measure";
import { LINE_FIELDS, type LineState } from "../element/figure/line/line_state";
import { serveLearnPackage } from "../engine/learn/wasm";
import { readHash } from "../link/hash";
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

test("the bet: a single dot has no slope", async () => {
  expect((await line.bet.reveal(engine)).answer).toBe("zero");
});

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
  expect(results.join()).toMatch(/^(refuse,)+(pass,)+(near,)*(no,?)+$/);
  expect(await result("A", { lambda: 0.0005 })).toEqual({ result: "refuse" });
  expect(await result("A", { lambda: 5 })).toEqual({ result: "no" });
  expect(await result("A", { lambda: 0.02, k: 40 })).toEqual({ result: "near", way: "other" });
});

test("B is passed from the least λ to half as much again", async () => {
  const { leastLambda } = await measureLine(engine, stateOf("B", {}));
  const least = Number(leastLambda);
  const above = async (lambda: number) => Math.abs(aboveMean(await fitOf(engine, stateOf("B", { lambda }))));
  expect(await above(least)).toBeLessThanOrEqual(0.1);
  expect(await above(least / 1.05)).toBeGreaterThan(0.1);
  const times = async (factor: number) => result("B", { lambda: least * factor });
  expect(await times(1.4)).toEqual({ result: "pass" });
  expect(await times(2)).toEqual({ result: "refuse" });
  expect(await times(0.7)).toEqual({ result: "near", way: "more" });
  expect(await times(0.1)).toEqual({ result: "no" });
  expect(await result("B", { k: 10 })).toEqual({ result: "near", way: "other" });
});

test("C needs another instant, a steep line and more than a dot", async () => {
  expect(await result("C", {})).toEqual({ result: "no" });
  expect(await result("C", { lambda: 5 })).toEqual({ result: "refuse" });
  expect(await result("C", { k: 1 })).toEqual({ result: "refuse" });
  expect(await result("C", { noise: 8, k: 40 })).toEqual({ result: "near", way: "other" });
});

test("misconceptions are refused with their sentence, in both languages", async () => {
  const measure = await measureLine(engine, stateOf("A", { lambda: 0.0005 }));
  const [en, de] = [await TEXTS.en.lessons.line!(), await TEXTS.de.lessons.line!()];
  expect(en.exercises.A!.refuse(saidIn("en", measure))).toMatch(/^The line follows 12 points.*1\.\d\d°.*1\.\d\d°/);
  expect(de.exercises.A!.refuse(saidIn("de", measure))).toMatch(/^Die Gerade folgt 12 Punkten.*1,\d\d°/);
  expect(en.exercises.A!.no(saidIn("en", measure))).toMatch(/^Only the mean is left/);
});

/** A sweep by one prediction after the other from a plain loop over fits would need the query's own past: ends are enough. */
test("without examples to follow every ridge errs alike", async () => {
  const state = stateOf("A", { k: 1, noise: 0 });
  const [small, great] = await sweepOf(engine, state, [0.0001, 10]);
  expect(small).toBeCloseTo(great!, 5);
});
