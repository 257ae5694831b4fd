import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { fastestSlide, legOf, measureFeet, solveLeg, tracksOf, votesOf } from "../element/figure/feet/feet_measure";
import { FEET_FIELDS, type FeetState, lookOf } from "../element/figure/feet/feet_state";
import { pivotTravel, solesOf } from "../element/figure/feet/soles";
import { serveLearnPackage } from "../engine/learn/wasm";
import { DEFAULT_PROPORTIONS, restPose } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { feet } from "./feet";
import { judge } from "./lesson";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(FEET_FIELDS);
const exercise = (id: string) => feet.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<FeetState>) =>
  judge(exercise(id), await measureFeet(engine, { ...readHash(FEET_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: a standing foot slides fastest at the strike", async () => {
  const { answer, measure } = await feet.bet.reveal(engine);
  expect(answer).toBe("strike");
  expect(Number(measure.most)).toBeGreaterThan(10 * Number(measure.middle));
  expect(Number(measure.held)).toBeLessThan(1);
});

test("soles of the T-pose are on the ground, and as long as the feet", () => {
  const [sole] = solesOf(restPose(), DEFAULT_PROPORTIONS, "left");
  expect(sole!.heel[1]).toBeCloseTo(0, 5);
  expect(sole!.ball[1]).toBeCloseTo(0, 5);
  expect(sole!.ball[2] - sole!.heel[2]).toBeCloseTo(1.35 * 0.128, 5);
});

test("a foot turns on the lower of heel and ball", () => {
  const before = { heel: [0, 0.1, 0], ball: [0, 0, 0] } as const;
  const after = { heel: [0.3, 0.1, 0], ball: [0.01, 0, 0] } as const;
  expect(pivotTravel(after, before)).toEqual([0.01, 0]);
  const level = { heel: [0.3, 0, 0], ball: [0.1, 0, 0] } as const;
  expect(pivotTravel(level, { heel: [0, 0, 0], ball: [0, 0, 0] })[0]).toBeCloseTo(0.2, 12);
});

test("with the hold, a standing foot of the engine stays where it is", async () => {
  const { held, free, stands } = await tracksOf(engine, PRESET);
  let [heldSum, freeSum, count, atRest] = [0, 0, 0, 0];
  for (let frame = 1; frame < stands.length; frame++) {
    if (stands[frame] !== 1) continue;
    count++;
    heldSum += held.speeds[frame]!;
    freeSum += free.speeds[frame]!;
    // The hold sets in over three frames.
    if (stands[frame - 1] === 1 && stands[frame - 2] === 1 && held.speeds[frame]! < 0.5) atRest++;
  }
  expect(heldSum / count).toBeLessThan(0.5);
  expect(freeSum / count).toBeGreaterThan(3);
  expect(atRest / count).toBeGreaterThan(0.9);
});

test("P is the share of the neighbours' voices for a stance", async () => {
  const { frames, votes, likelihoods } = await votesOf(engine, PRESET, 882);
  expect(frames[0]).toBe(120);
  expect(frames.at(-1)).toBe(237);
  const { voices, contacts } = await engine.contacts(lookOf(PRESET, frames[10]!));
  let [sum, total] = [0, 0];
  for (let i = 0; i < voices.length; i += 2) {
    sum += voices[i]! * contacts[i]!;
    total += voices[i]!;
  }
  expect(votes[10]).toBeCloseTo(sum / total, 5);
  const { stands } = await tracksOf(engine, PRESET);
  frames.forEach((frame, i) => {
    if (likelihoods[i]! > 0.9) expect(stands[frame], `frame ${frame}`).toBe(1);
  });
});

test("the knee has the angle that thigh and shin make", async () => {
  const [a, b] = await legOf(engine, PRESET.motion);
  expect(a).toBeCloseTo(0.391, 3);
  expect(b).toBeCloseTo(0.41, 3);
  for (const gamma of [40, 90, 150]) {
    const radians = (gamma * Math.PI) / 180;
    // The shin's end, with the thigh along −y and the knee at its end.
    const [x, y] = [b * Math.sin(radians), -a + b * Math.cos(radians)];
    expect(solveLeg([a, b], x, y).gamma).toBeCloseTo(gamma, 6);
  }
  expect(solveLeg([a, b], 0, -2).bend).toBeCloseTo(0, 6);
});

test("A is passed at the strike alone, and refuses a lifted foot", async () => {
  const tracks = await tracksOf(engine, PRESET);
  const fastest = fastestSlide(tracks, 120);
  const passing: number[] = [];
  for (let at = 120; at < 240; at++) if ((await result("A", { at })).result === "pass") passing.push(at);
  expect(passing[0]).toBe(fastest);
  expect(passing).toHaveLength(4);
  expect(tracks.stands[fastest - 1]).toBe(0);
  expect(await result("A", { at: fastest - 1 })).toEqual({ result: "refuse" });
  expect(await result("A", { at: fastest + 5 })).toEqual({ result: "near", way: "earlier" });
  expect(await result("A", { at: 150 })).toEqual({ result: "no" });
  expect(await result("A", { at: fastest, foot: "right" })).toEqual({ result: "near", way: "other" });
  const text = await TEXTS.en.lessons.feet!();
  const said = saidIn("en", await measureFeet(engine, { ...PRESET, at: 180 }));
  expect(text.exercises.A!.refuse(said)).toMatch(/^A lifted foot may move, even at 29\d\.\d\d cm\/s/);
});

test("B refuses the angle between the bones", async () => {
  const [a, b] = await legOf(engine, PRESET.motion);
  const at = (gamma: number) => -Math.sqrt(a * a + b * b - 2 * a * b * Math.cos((gamma * Math.PI) / 180));
  expect((await result("B", {})).result).toBe("no");
  expect(await result("B", { x: 0, y: at(120) })).toEqual({ result: "pass" });
  expect(await result("B", { x: 0, y: at(60) })).toEqual({ result: "refuse" });
  expect(await result("B", { x: 0, y: at(123) })).toEqual({ result: "near", way: "more" });
  expect(await result("B", { x: 0, y: at(117) })).toEqual({ result: "near", way: "less" });
});
