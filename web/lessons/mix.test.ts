import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { measureMix, readingOf, sharesOf, weightAlone } from "../element/figure/mix/mix_measure";
import { MIX_FIELDS, type MixState } from "../element/figure/mix/mix_state";
import { serveLearnPackage } from "../engine/learn/wasm";
import { readHash } from "../link/hash";
import { judge } from "./lesson";
import { mix } from "./mix";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const exercise = (id: string) => mix.exercises.find((one) => one.id === id)!;
const stateOf = (id: string, patch: Partial<MixState>): MixState => ({
  ...readHash(MIX_FIELDS, exercise(id).start("")),
  ...patch,
});
const result = async (id: string, patch: Partial<MixState>) =>
  judge(exercise(id), await measureMix(engine, stateOf(id, patch)));

test("the bet: a wider δ costs the winner", async () => {
  expect((await mix.bet.reveal(engine)).answer).toBe("loses");
});

test("weights of all actions are 1 in every frame, and those of a frame are the lens's", async () => {
  const state = stateOf("A", { at: 137 });
  const { weights, frames, actions } = await readingOf(engine, state.motion, state.delta);
  for (let frame = 0; frame < frames; frame += 50)
    expect(weights.reduce((sum, of) => sum + of[frame]!, 0)).toBeCloseTo(1, 4);
  const shares = await sharesOf(engine, state);
  const walking = shares.reduce((sum, { action, weight }) => sum + (action === "walk" ? weight : 0), 0);
  expect(weights[actions.indexOf("walk")]![137]).toBeCloseTo(walking, 3);
  expect(shares.map(({ square }) => square)).toEqual(shares.map(({ square }) => square).sort((a, b) => a - b));
});

test("two distances of 1 : 2 with δ 0.7 give 0.81 : 0.19", () => {
  expect(weightAlone([1, 2], 0.7)).toBeCloseTo(0.81, 2);
  expect(weightAlone([30, 60], 0.7)).toBeCloseTo(0.81, 2);
});

test("A is passed where running becomes walking, and refused where it has become it", async () => {
  expect(await result("A", { at: 137 })).toEqual({ result: "pass" });
  expect(await result("A", { at: 134 })).toEqual({ result: "near", way: "later" });
  expect(await result("A", { at: 141 })).toEqual({ result: "near", way: "earlier" });
  expect(await result("A", { at: 100 })).toEqual({ result: "no" });
  const { change } = await measureMix(engine, stateOf("A", {}));
  expect(change).toBe(137);
  const { weights, actions } = await readingOf(engine, stateOf("A", {}).motion, stateOf("A", {}).delta);
  const certain = weights[actions.indexOf("walk")]!.findIndex((weight) => weight > 0.95);
  expect(await result("A", { at: certain })).toEqual({ result: "refuse" });
});

test("B is passed at one width only", async () => {
  const passing: number[] = [];
  for (let i = 0; i <= 60; i++) {
    const delta = Number((0.1 * 50 ** (i / 60)).toFixed(2));
    if ((await result("B", { delta })).result === "pass") passing.push(delta);
  }
  expect(passing.length).toBeGreaterThan(0);
  expect(Math.min(...passing)).toBeGreaterThan(0.65);
  expect(Math.max(...passing)).toBeLessThan(0.8);
  expect(await result("B", { delta: 0.5 })).toEqual({ result: "refuse" });
  expect(await result("B", { delta: 3 })).toEqual({ result: "no" });
  expect(await result("B", { at: 100 })).toEqual({ result: "near", way: "other" });
});

test("C is computed from the two distances, and exp(−D) is refused with its sentence", async () => {
  const measure = await measureMix(engine, stateOf("C", {}));
  const [alone, plain] = [Number(measure.alone), Number(measure.plain)];
  expect(Math.abs(alone - plain), "the mistake gives another number").toBeGreaterThan(0.05);
  expect(await result("C", { guess: Number(alone.toFixed(2)) })).toEqual({ result: "pass" });
  expect(await result("C", { guess: Number(plain.toFixed(3)) })).toEqual({ result: "refuse" });
  expect(await result("C", {})).toEqual({ result: "near", way: "none" });
  expect(await result("C", { guess: alone - 0.015 })).toEqual({ result: "near", way: "more" });
  expect(await result("C", { guess: 0 })).toEqual({ result: "no" });
  const said = saidIn("en", await measureMix(engine, stateOf("C", { guess: plain })));
  expect((await TEXTS.en.lessons.mix!()).exercises.C!.refuse(said)).toMatch(/^That is exp\(−D\): 0\.\d\d\./);
});
