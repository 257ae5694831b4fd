import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { serveLearnPackage } from "../engine/learn/wasm";
import { STYLES } from "../figures/built_in";
import {
  frameAtSecond,
  kernelAt,
  lengthOf,
  longestOf,
  measurePace,
  pacedOf,
  ratioOf,
} from "../figures/pace/pace_measure";
import { lookOf, PACE_FIELDS, type PaceState } from "../figures/pace/pace_state";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { TEXTS } from "./text";
import { time } from "./time";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(PACE_FIELDS);
const exercise = (id: string) => time.exercises.find((one) => one.id === id)!;
const measureOf = (id: string, patch: Partial<PaceState>) =>
  measurePace(engine, { ...readHash(PACE_FIELDS, exercise(id).start("")), ...patch });
const result = async (id: string, patch: Partial<PaceState>) => judge(exercise(id), await measureOf(id, patch));
const said = async (language: "en" | "de", id: string, patch: Partial<PaceState>) =>
  saidIn(language, await measureOf(id, patch), time.decimals);

test("the bet: half of old is half of the delay", async () => {
  const { answer, measure } = await time.bet.reveal(engine);
  expect(answer).toBe("half");
  expect(Number(measure.all)).toBeGreaterThan(30);
  expect(Number(measure.share)).toBeCloseTo(0.5, 2);
});

test("the length is the sum of the durations that the engine gives frame by frame", async () => {
  const state: PaceState = { ...PRESET, old: 0.4, childlike: 0.3 };
  const paced = await pacedOf(engine, state);
  const { timeOut } = paced.styled;
  expect(lengthOf(paced)).toBeCloseTo(timeOut.at(-1)!, 4);
  let sum = 0;
  for (let at = 121; at <= 180; at++) sum += (await engine.styled(lookOf({ ...state, at }))).secs;
  expect(timeOut[180]! - timeOut[120]!).toBeCloseTo(sum, 4);
  const other = await pacedOf(engine, { ...state, old: 0.6 });
  expect(
    Math.abs(other.styled.timeOut[180]! - other.styled.timeOut[120]! - sum),
    "mutation: another blend",
  ).toBeGreaterThan(0.03);
});

test("no style at all keeps the input's pace", async () => {
  expect(ratioOf(await pacedOf(engine, { ...PRESET, old: 0 }))).toBeCloseTo(1, 3);
});

test("at a second of its clock the blend has come to the frame of that time", async () => {
  const paced = await pacedOf(engine, PRESET);
  const { timeOut } = paced.styled;
  expect(frameAtSecond(paced, timeOut[300]!)).toBeCloseTo(300, 3);
  expect(frameAtSecond(paced, (timeOut[300]! + timeOut[301]!) / 2)).toBeCloseTo(300.5, 2);
});

test("the duration of a style is the neighbours' mean by the kernel", async () => {
  const { distances, durations, kernel, weights, bandwidth, duration } = await engine.timing(lookOf(PRESET), "old");
  expect(bandwidth).toBeCloseTo(distances.reduce((sum, d) => sum + d, 0) / distances.length, 3);
  const nearest = kernelAt(Math.min(...distances), bandwidth);
  let [sum, total] = [0, 0];
  distances.forEach((d, i) => {
    const g = kernelAt(d, bandwidth);
    // The engine's value is relative to the nearest neighbour's.
    if (Math.abs(g / nearest - kernel[i]!) > 1e-3) throw new Error(`neighbour ${i}: ${g} for ${kernel[i]}`);
    sum += weights[i]! * g * durations[i]!;
    total += weights[i]! * g;
  });
  expect(duration).toBeCloseTo(sum / total, 6);
  const plain = durations.reduce((all, w) => all + w, 0) / durations.length;
  expect(Math.abs(duration! - plain), "mutation: all weights equal").toBeGreaterThan(1e-5);
});

test("the slowest performance is that of the longest recording", async () => {
  const { style, ratio } = await longestOf(engine, PRESET.motion);
  const performed = (await engine.counterpart(PRESET.motion, style))!;
  expect(style).toBe("depressed");
  for (const other of STYLES.filter((name) => name !== style)) {
    const { timeOut } = (await engine.counterpart(PRESET.motion, other))!;
    expect(timeOut.at(-1)! / ((timeOut.length - 1) / 60), other).toBeLessThan(ratio);
  }
  expect(ratio).toBeCloseTo(performed.timeOut.at(-1)! / ((performed.timeOut.length - 1) / 60), 6);
});

test("A is passed by a narrow stretch of weights, and refuses the delay as a weight", async () => {
  expect((await result("A", {})).result).toBe("no");
  expect(await result("A", { old: 0.2 })).toEqual({ result: "refuse" });
  expect(await result("A", { old: 0.59 })).toEqual({ result: "near", way: "more" });
  expect(await result("A", { old: 0.64 })).toEqual({ result: "near", way: "less" });
  for (const old of [0.6, 0.61, 0.62]) expect(await result("A", { old })).toEqual({ result: "pass" });
  expect(await result("A", { old: 0.61, childlike: 0.1 })).toEqual({ result: "near", way: "other" });
  expect(await result("A", { old: 0.61, motion: "neutral run" })).toEqual({ result: "near", way: "other" });
  const text = { en: await TEXTS.en.lessons.time!(), de: await TEXTS.de.lessons.time!() };
  expect(text.en.exercises.A!.refuse(await said("en", "A", { old: 0.2 }))).toMatch(
    /^0\.20 is the weight, not the delay: .* Now it is 1\.07 times\.$/,
  );
  expect(text.de.exercises.A!.refuse(await said("de", "A", { old: 0.2 }))).toMatch(/^0,20 ist das Gewicht/);
});

test("B wants both styles, and refuses equal weights", async () => {
  expect(await result("B", {})).toEqual({ result: "refuse" });
  expect(await result("B", { old: 0.26, childlike: 0.7 })).toEqual({ result: "pass" });
  expect(await result("B", { old: 0.25, childlike: 0.6 })).toEqual({ result: "near", way: "slow" });
  expect(await result("B", { old: 0.25, childlike: 0.73 })).toEqual({ result: "near", way: "fast" });
  expect(await result("B", { old: 0.1, childlike: 0.3 })).toEqual({ result: "near", way: "other" });
  expect(await result("B", { old: 0.4, childlike: 0.7 })).toEqual({ result: "near", way: "other" });
  expect(await result("B", { old: 0.26, childlike: 0.7, motion: "neutral run" })).toEqual({
    result: "near",
    way: "motion",
  });
  expect(await result("B", { old: 0.4, childlike: 0.6 })).toEqual({ result: "no" });
  const text = { en: await TEXTS.en.lessons.time!(), de: await TEXTS.de.lessons.time!() };
  const equal = { old: 0.5, childlike: 0.5 };
  expect(text.en.exercises.B!.refuse(await said("en", "B", equal))).toMatch(
    /^Equal weights do not cancel: .* Now it is 1\.10 times as long\.$/,
  );
  expect(text.de.exercises.B!.refuse(await said("de", "B", equal))).toMatch(/^Gleiche Gewichte heben sich nicht auf/);
});

test("C is only passed beyond the data", async () => {
  expect(await result("C", { old: 1 })).toEqual({ result: "refuse" });
  expect(await result("C", { old: 1.3 })).toEqual({ result: "near", way: "further" });
  expect(await result("C", { old: 1.55 })).toEqual({ result: "pass" });
  expect(await result("C", { old: 1.55, motion: "neutral run" })).toEqual({ result: "near", way: "other" });
  expect(await result("C", { childlike: 1.5, old: -0.25 })).toEqual({ result: "no" });
  const text = { en: await TEXTS.en.lessons.time!(), de: await TEXTS.de.lessons.time!() };
  expect(text.en.exercises.C!.refuse(await said("en", "C", { old: 1 }))).toMatch(
    /^Within the triangle nothing is slower .* now 1\.33 times\. Leave the triangle\.$/,
  );
  expect(text.de.exercises.C!.refuse(await said("de", "C", { old: 1 }))).toMatch(/^Im Dreieck ist nichts langsamer/);
});

test("numbers of the text are the engine's", async () => {
  const text = await TEXTS.en.lessons.time!();
  const { rateHz } = await engine.motion({ name: PRESET.motion });
  expect(text.look.join(" ")).toContain(`${(1000 / rateHz).toFixed(1)} ms`);
  expect(text.exercises.A!.task).toContain("1.2 times");
  expect(text.exercises.A!.hints[1]).toContain("Divide 0.2 by");
});
