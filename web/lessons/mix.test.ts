import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { DEFAULT_OPTIONS } from "../client/protocol";
import { serveLearnPackage } from "../engine/learn/wasm";
import {
  FLOOR,
  HALF_KNOWN,
  measureMix,
  readingOf,
  sharesOf,
  WIDEST,
  weightAlone,
  widthAt,
} from "../figures/mix/mix_measure";
import { MIX_FIELDS, type MixState } from "../figures/mix/mix_state";
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
const said = async (language: "en" | "de", id: string, patch: Partial<MixState>) =>
  saidIn(language, await measureMix(engine, stateOf(id, patch)), mix.decimals);

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

/** λ of all classes by Eq. 4, in plain loops. */
function weightsOf(squares: readonly number[], width: number): number[] {
  const least = Math.min(...squares);
  const raw = squares.map((square) => Math.exp(-square / (width * least)));
  const sum = raw.reduce((total, weight) => total + weight, 0);
  return raw.map((weight) => weight / sum);
}

test("weights are those of Eq. 4, with a δ that is wider where the nearest class is far", async () => {
  // The second frame is within the database, the first and the third are not.
  for (const [at, factor] of [
    [60, 1.19],
    [460, 1],
    [137, 2.7],
  ] as const) {
    const state = stateOf("A", { at });
    const shares = await sharesOf(engine, state);
    const squares = shares.map(({ square }) => square);
    const width = widthAt(squares[0]!, state.delta);
    expect(width / state.delta).toBeCloseTo(factor, 1);
    const [weights, mutated] = [weightsOf(squares, width), weightsOf(squares, 1.5 * width)];
    for (const [i, { weight }] of shares.entries()) expect(weight).toBeCloseTo(weights[i]!, 3);
    expect(Math.abs(shares[0]!.weight - mutated[0]!), "mutation: another δ").toBeGreaterThan(0.03);
    const other = await sharesOf(engine, { ...state, at: at + 20 });
    expect(Math.abs(squares[0]! - other[0]!.square), "mutation: another frame").toBeGreaterThan(0.5);
  }
});

test("D is the mean squared distance of a class’s nearest windows", async () => {
  const state = stateOf("A", {});
  const { classes } = await engine.database();
  const [first] = await sharesOf(engine, state);
  const number = classes.findIndex(({ action, style }) => action === first!.action && style === first!.style);
  const look = { input: { name: state.motion }, styles: { old: 1 }, frame: state.at };
  const meanOf = async (k: number) => {
    const { distances } = await engine.neighbours(look, k, { class: number });
    return (1e4 * distances.reduce((sum, d) => sum + d * d, 0)) / distances.length;
  };
  expect(Math.abs((await meanOf(DEFAULT_OPTIONS.k)) / first!.square - 1)).toBeLessThan(1e-3);
  expect(Math.abs((await meanOf(10)) / first!.square - 1), "mutation: fewer neighbours").toBeGreaterThan(0.01);
});

test("A is passed where running becomes walking, and refused where it has become it", async () => {
  const { change } = await measureMix(engine, stateOf("A", {}));
  const { weights, actions } = await readingOf(engine, stateOf("A", {}).motion, stateOf("A", {}).delta);
  const [walk, run] = ["walk", "run"].map((action) => weights[actions.indexOf(action)]!) as [
    Float32Array,
    Float32Array,
  ];
  expect(change, "of the whole input").toBe(walk.findIndex((weight, frame) => weight >= run[frame]!));
  const at = Number(change);
  for (const passing of [at - 2, at, at + 2]) expect(await result("A", { at: passing })).toEqual({ result: "pass" });
  expect(await result("A", { at: at - 3 })).toEqual({ result: "near", way: "later" });
  expect(await result("A", { at: at + 4 })).toEqual({ result: "near", way: "earlier" });
  expect(await result("A", { at: at - 5 })).toEqual({ result: "no" });
  const certain = walk.findIndex((weight) => weight > 0.95);
  expect(await result("A", { at: certain })).toEqual({ result: "refuse" });
  expect(await result("A", { at, delta: 1 })).toEqual({ result: "near", way: "other" });
  expect(await result("A", { at, motion: "neutral run" })).toEqual({ result: "near", way: "other" });
  const text = { en: await TEXTS.en.lessons.mix!(), de: await TEXTS.de.lessons.mix!() };
  expect(text.en.exercises.A!.refuse(await said("en", "A", { at: certain }))).toMatch(
    /^Here it has changed already: walking has (0\.9\d|1\.00), running 0\.\d\d/,
  );
  expect(text.de.exercises.A!.refuse(await said("de", "A", { at: certain }))).toMatch(/^Hier ist der Wechsel vorbei/);
});

test("B is passed at one width only", async () => {
  const { delta } = stateOf("B", readHash(MIX_FIELDS, await exercise("B").solve(engine)));
  const squares = (await sharesOf(engine, stateOf("B", {}))).map(({ square }) => square);
  const running = (width: number) => weightsOf(squares, widthAt(squares[0]!, width))[0]!;
  expect(running(delta)).toBeCloseTo(0.5, 2);
  expect(Math.abs(running(1.2 * delta) - 0.5), "mutation: another δ").toBeGreaterThan(0.03);
  expect(await result("B", { delta })).toEqual({ result: "pass" });
  expect(await result("B", { delta: delta - 0.05 })).toEqual({ result: "near", way: "more" });
  expect(await result("B", { delta: delta + 0.06 })).toEqual({ result: "near", way: "less" });
  expect(await result("B", { delta: 0.5 })).toEqual({ result: "refuse" });
  expect(await result("B", { delta: 3 })).toEqual({ result: "no" });
  expect(await result("B", { delta, at: 100 })).toEqual({ result: "near", way: "other" });
  expect(await result("B", { delta, motion: "neutral run" })).toEqual({ result: "near", way: "other" });
  const text = { en: await TEXTS.en.lessons.mix!(), de: await TEXTS.de.lessons.mix!() };
  expect(text.en.exercises.B!.refuse(await said("en", "B", { delta: 0.5 }))).toMatch(
    /^δ is a width, not a weight: with δ 0\.50 neutral running has 0\.\d\d, not one half\.$/,
  );
  expect(text.de.exercises.B!.refuse(await said("de", "B", { delta: 0.5 }))).toMatch(/^δ ist eine Breite und kein/);
});

test("C is computed from the two distances, and exp(−D) is refused with its sentence", async () => {
  const measure = await measureMix(engine, stateOf("C", {}));
  const [alone, plain] = [Number(measure.alone), Number(measure.plain)];
  const [first, second] = [Number(measure.first), Number(measure.second)];
  const { delta } = stateOf("C", {});
  expect(alone).toBeCloseTo(weightsOf([first, second], delta)[0]!, 6);
  expect(Math.abs(alone - weightsOf([first, second], 0.7 * delta)[0]!), "mutation: another δ").toBeGreaterThan(0.03);
  expect(plain).toBeCloseTo(Math.exp(-first) / (Math.exp(-first) + Math.exp(-second)), 6);
  expect(widthAt(first, delta) / delta, "nothing widens δ").toBeCloseTo(1, 3);
  expect(Math.abs(alone - plain), "the mistake gives another number").toBeGreaterThan(0.1);
  expect(await result("C", { guess: Number(alone.toFixed(2)) })).toEqual({ result: "pass" });
  expect(await result("C", { guess: Number(plain.toFixed(3)) })).toEqual({ result: "refuse" });
  expect(await result("C", {})).toEqual({ result: "near", way: "none" });
  expect(await result("C", { guess: alone - 0.015 })).toEqual({ result: "near", way: "more" });
  expect(await result("C", { guess: alone + 0.015 })).toEqual({ result: "near", way: "less" });
  expect(await result("C", { guess: 0 })).toEqual({ result: "no" });
  for (const patch of [{ at: 60 }, { delta: 0.1 }, { motion: "neutral run" }] as const)
    expect(await result("C", { guess: alone, ...patch })).toEqual({ result: "near", way: "other" });
  const text = { en: await TEXTS.en.lessons.mix!(), de: await TEXTS.de.lessons.mix!() };
  expect(text.en.exercises.C!.refuse(await said("en", "C", { guess: plain }))).toMatch(
    /^That is exp\(−D\): 0\.\d{3}\./,
  );
  expect(text.de.exercises.C!.refuse(await said("de", "C", { guess: plain }))).toMatch(/^Das ist exp\(−D\): 0,\d{3}\./);
});

test("numbers of the text are the engine's", async () => {
  const rust = (file: string) =>
    readFileSync(join(import.meta.dirname, "../../rust/strut-core/src/transfer", file), "utf8");
  const mixture = rust("class_weights.rs");
  expect(mixture).toContain("const FLOOR: f32 = 1e-6;");
  expect(FLOOR, "cm²").toBe(1e-6 * 1e4);
  expect(mixture).toContain("const HALF_KNOWN: f32 = 0.05 * 0.05;");
  expect(HALF_KNOWN, "cm²").toBeCloseTo(0.05 * 0.05 * 1e4, 9);
  expect(mixture).toContain(`const WIDEST: f32 = ${WIDEST}.0;`);
  expect(widthAt(HALF_KNOWN, 1), "twice where it is known by half").toBeCloseTo(2, 9);
  expect(rust("options.rs")).toContain("least_weight: 2e-5,");
  const { classes, actions, styles } = await engine.database();
  expect([classes.length, actions.length, styles.length], "forty classes: five actions, each in eight styles").toEqual([
    40, 5, 8,
  ]);
});

test("before and after the jumps a kick is read, where the input stands still", async () => {
  const state = stateOf("A", {});
  const { weights, actions } = await readingOf(engine, state.motion, state.delta);
  const { rows } = await engine.motion({ name: state.motion });
  const [kick, jump] = ["kick", "jump"].map((action) => weights[actions.indexOf(action)]!) as [
    Float32Array,
    Float32Array,
  ];
  for (const at of [456, 576]) {
    expect(kick[at], `frame ${at}`).toBeGreaterThan(0.9);
    // Velocity of the hips, m/s: the numbers after the joints and the height.
    expect(Math.hypot(rows[at * 68 + 64]!, rows[at * 68 + 65]!), `frame ${at}`).toBeLessThan(0.1);
  }
  const leap = jump.findIndex((weight) => weight > 0.9);
  expect(leap).toBeGreaterThan(456);
  expect(jump.findLastIndex((weight) => weight > 0.9)).toBeLessThan(576);
});

test("an instant after the end is the last", async () => {
  const { frames, rateHz } = await readingOf(engine, stateOf("A", {}).motion, stateOf("A", {}).delta);
  const { secs } = await measureMix(engine, stateOf("A", { at: 5000 }));
  expect(secs).toBeCloseTo((frames - 1) / rateHz, 6);
});
