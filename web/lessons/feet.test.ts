import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { DEFAULT_OPTIONS } from "../client/protocol";
import { serveLearnPackage } from "../engine/learn/wasm";
import {
  fastestSlide,
  legOf,
  measureFeet,
  PLANT,
  RELEASE,
  solveLeg,
  tracksOf,
  votesOf,
} from "../figures/feet/feet_measure";
import { FEET_FIELDS, type FeetState, lookOf } from "../figures/feet/feet_state";
import { pivotTravel, solesOf } from "../figures/feet/soles";
import { correctionOf } from "../figures/feet/soles_figure";
import { createWorldPose, DEFAULT_PROPORTIONS, JOINT, POSE_FLOATS, restPose, worldFromLocal } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { feet } from "./feet";
import { judge } from "./lesson";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(FEET_FIELDS);
const exercise = (id: string) => feet.exercises.find((one) => one.id === id)!;
const said = async (language: "en" | "de", patch: Partial<FeetState>) =>
  saidIn(language, await measureFeet(engine, { ...PRESET, ...patch }), feet.decimals);
const result = async (id: string, patch: Partial<FeetState>) =>
  judge(exercise(id), await measureFeet(engine, { ...readHash(FEET_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: a standing foot slides fastest at the strike", async () => {
  const { answer, measure } = await feet.bet.reveal(engine);
  expect(answer).toBe("strike");
  expect(Number(measure.most)).toBeGreaterThan(10 * Number(measure.middle));
  expect(Number(measure.held)).toBeLessThan(1);
  const text = await TEXTS.en.lessons.feet!();
  expect(text.bet.reveal(saidIn("en", measure, feet.decimals))).toMatch(
    /^This stance has 46 frames, and the foot slides fastest in frame 1: at 61 cm\/s, against \d\.\d cm\/s in the middle/,
  );
});

test("what the texts say of the engine's constants is so", async () => {
  const source = (file: string) =>
    readFileSync(join(import.meta.dirname, "..", "..", "rust/strut-core/src/transfer", file), "utf8");
  const votes = source("contact_likelihood.rs");
  const constant = (text: string, name: string) =>
    Number(new RegExp(`const ${name}: \\w+ = ([\\d.]+);`).exec(text)![1]);
  expect([constant(votes, "PLANT"), constant(votes, "RELEASE")]).toEqual([PLANT, RELEASE]);
  expect(feet.equation).toContain(`${constant(votes, "SAME")}`);
  expect(constant(source("footplant.rs"), "EASE_FRAMES")).toBe(3);
  const { voices } = await engine.contacts(lookOf(PRESET, 160));
  expect(voices).toHaveLength(2 * constant(votes, "VOTERS"));
  const [en, de] = [await TEXTS.en.lessons.feet!(), await TEXTS.de.lessons.feet!()];
  expect(en.look.join(" ")).toMatch(/The 40 most similar.*P 0\.6 on.*below 0\.4.*over three frames/);
  expect(de.look.join(" ")).toMatch(/Die 40 ähnlichsten.*Ab P 0,6.*unter 0,4.*über drei Bilder/);
  expect(en.why).toMatch(/0\.6 to plant, 0\.4 to release/);
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

/** Speed of the lower of heel and ball, by plain loops over the poses, cm/s. */
function speedsOf(poses: Float32Array, proportions: Float32Array, timeOut: Float32Array, side: "left" | "right") {
  const [foot, toes] = [3 * JOINT[`${side}_foot`], 3 * JOINT[`${side}_toes`]];
  const world = createWorldPose();
  const rest = restPose();
  rest[1] = proportions[1]!;
  worldFromLocal(proportions, rest, world);
  const [ankleHeight, toeHeight] = [world.positions[foot + 1]!, world.positions[toes + 1]!];
  // The heel in the ankle's frame, and the ball in the toes'.
  const heel = [-0.35 * proportions[toes]!, -ankleHeight, -0.35 * proportions[toes + 2]!];
  const ball = [0, -toeHeight, 0];
  const points = Array.from({ length: poses.length / POSE_FLOATS }, (_, frame) => {
    worldFromLocal(proportions, poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS), world);
    return [
      [foot, heel],
      [toes, ball],
    ].map(([joint, offset]) => {
      const [x, y, z, w] = world.rotations.subarray((4 * (joint as number)) / 3);
      const [a, b, c] = offset as number[];
      // The matrix of the quaternion.
      const rows = [
        [1 - 2 * (y! * y! + z! * z!), 2 * (x! * y! - z! * w!), 2 * (x! * z! + y! * w!)],
        [2 * (x! * y! + z! * w!), 1 - 2 * (x! * x! + z! * z!), 2 * (y! * z! - x! * w!)],
        [2 * (x! * z! - y! * w!), 2 * (y! * z! + x! * w!), 1 - 2 * (x! * x! + y! * y!)],
      ];
      return rows.map(
        (row, axis) => world.positions[(joint as number) + axis]! + row[0]! * a! + row[1]! * b! + row[2]! * c!,
      );
    });
  });
  return points.map((now, frame) => {
    const before = points[frame - 1];
    if (!before) return 0;
    const onHeel = Math.min(1, Math.max(0, 0.5 + (now[1]![1]! - now[0]![1]!) / 0.04));
    const way = [0, 2].map(
      (axis) => onHeel * (now[0]![axis]! - before[0]![axis]!) + (1 - onHeel) * (now[1]![axis]! - before[1]![axis]!),
    );
    return (100 * Math.sqrt(way[0]! ** 2 + way[1]! ** 2)) / (timeOut[frame]! - timeOut[frame - 1]!);
  });
}

test("speeds, and the fastest slide, are those of plain loops over the poses", async () => {
  const { free, held, stands } = await tracksOf(engine, PRESET);
  const run = (footplant: boolean) =>
    engine.stylize({ name: PRESET.motion }, { ...DEFAULT_OPTIONS, styles: { old: 1 }, footplant });
  const [{ poses, timeOut }, { proportions }] = [await run(false), await engine.motion({ name: PRESET.motion })];
  const speeds = speedsOf(poses, proportions, timeOut, "left");
  speeds.forEach((speed, frame) => {
    expect(Math.abs(free.speeds[frame]! - speed), `frame ${frame}`).toBeLessThan(0.1);
  });
  let fastest = 120;
  for (let frame = 120; frame < 240; frame++)
    if (stands[frame] === 1 && (stands[fastest] === 0 || speeds[frame]! > speeds[fastest]!)) fastest = frame;
  expect(fastestSlide({ rateHz: 60, free, held, stands }, 120)).toBe(fastest);
  // Mutations: the other foot, the held foot, and a later frame are all far off where it slides fastest.
  const right = speedsOf(poses, proportions, timeOut, "right");
  for (const other of [right[fastest]!, held.speeds[fastest]!, speeds[fastest + 1]!])
    expect(Math.abs(free.speeds[fastest]! - other), "mutation").toBeGreaterThan(30);
});

test("the hold moves a standing foot back by what it has slid", async () => {
  const { held, free } = await tracksOf(engine, PRESET);
  // From the full onset of the hold to the end of the stance.
  const [from, to] = [129, 168];
  const q = (frame: number, axis: 0 | 2) => {
    const middle = (soles: typeof held.soles) => (soles[frame]!.heel[axis] + soles[frame]!.ball[axis]) / 2;
    return 100 * (middle(held.soles) - middle(free.soles));
  };
  const slid = [0, 0];
  for (let frame = from + 1; frame <= to; frame++)
    pivotTravel(free.soles[frame]!, free.soles[frame - 1]!).forEach((way, axis) => {
      slid[axis]! += 100 * way;
    });
  const moved = ([0, 2] as const).map((axis) => q(to, axis) - q(from, axis));
  expect(Math.hypot(...slid)).toBeGreaterThan(0.5);
  expect(Math.hypot(moved[0]! + slid[0]!, moved[1]! + slid[1]!)).toBeLessThan(0.2);
  expect(Math.hypot(moved[0]! - slid[0]!, moved[1]! - slid[1]!), "mutation: the other way").toBeGreaterThan(1);
  expect(Math.hypot(q(to, 0), q(to, 2))).toBeCloseTo(correctionOf({ held, free }, to), 6);
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

test("a frame beyond the end of the motion is its last", async () => {
  const far = await measureFeet(engine, { ...PRESET, at: 5000 });
  const { stands } = await tracksOf(engine, PRESET);
  expect(far).toEqual(await measureFeet(engine, { ...PRESET, at: stands.length - 1 }));
  const { frames } = await votesOf(engine, { ...PRESET, at: 5000 }, stands.length);
  expect(frames.length).toBeGreaterThan(5);
  expect(frames.at(-1)).toBeLessThan(stands.length);
});

test("A is passed at the strike alone, with the hold off, and refuses a lifted foot", async () => {
  const tracks = await tracksOf(engine, PRESET);
  const fastest = fastestSlide(tracks, 120);
  const passing: number[] = [];
  for (let at = 120; at < 240; at++) if ((await result("A", { at })).result === "pass") passing.push(at);
  // Three frames after the strike; in those before it the foot is not planted.
  expect(passing).toEqual([fastest, fastest + 1, fastest + 2, fastest + 3]);
  expect(tracks.stands[fastest - 1]).toBe(0);
  expect(await result("A", { at: fastest - 1 })).toEqual({ result: "near", way: "later" });
  expect(await result("A", { at: fastest - 6 })).toEqual({ result: "near", way: "later" });
  expect(await result("A", { at: fastest + 5 })).toEqual({ result: "near", way: "earlier" });
  expect(await result("A", { at: fastest, hold: true })).toEqual({ result: "near", way: "held" });
  expect(await result("A", { at: 150 })).toEqual({ result: "no" });
  for (const other of [{ foot: "right" }, { style: "sexy" }, { motion: "neutral run" }, { at: 250 }] as const)
    expect(await result("A", { at: fastest, ...other })).toEqual({ result: "near", way: "other" });
  // The misconception: the fastest instant of all.
  let any = 120;
  for (let at = 120; at < 240; at++) if (tracks.free.speeds[at]! > tracks.free.speeds[any]!) any = at;
  expect(await result("A", { at: any })).toEqual({ result: "refuse" });
  const [en, de] = [await TEXTS.en.lessons.feet!(), await TEXTS.de.lessons.feet!()];
  expect(en.exercises.A!.refuse(await said("en", { at: any }))).toMatch(
    /^A lifted foot may move, even at (29\d|30\d) cm\/s\./,
  );
  expect(de.exercises.A!.refuse(await said("de", { at: any }))).toMatch(
    /^Ein gehobener Fuß darf sich bewegen, auch mit (29\d|30\d) cm\/s\./,
  );
});

test("B refuses the angle between the bones, and says both", async () => {
  const [a, b] = await legOf(engine, PRESET.motion);
  const at = (gamma: number) => -Math.sqrt(a * a + b * b - 2 * a * b * Math.cos((gamma * Math.PI) / 180));
  expect((await result("B", {})).result).toBe("no");
  expect(await result("B", { x: 0, y: at(120) })).toEqual({ result: "pass" });
  expect(await result("B", { x: 0, y: at(60) })).toEqual({ result: "refuse" });
  expect(await result("B", { x: 0, y: at(123) })).toEqual({ result: "near", way: "more" });
  expect(await result("B", { x: 0, y: at(117) })).toEqual({ result: "near", way: "less" });
  const passing = Array.from({ length: 200 }, (_, i) => 0.6 + i / 1000).filter(
    (d) => Math.abs(solveLeg([a, b], 0, -d).bend - 60) <= 1,
  );
  expect([passing[0], passing.at(-1)]).toEqual([expect.closeTo(0.691, 6), expect.closeTo(0.697, 6)]);
  const text = await TEXTS.en.lessons.feet!();
  expect(text.exercises.B!.refuse(await said("en", { x: 0, y: at(60) }))).toMatch(
    /^γ is (59\.9|60\.0|60\.1)°, the angle between the bones\. .*this knee is bent by (119\.9|120\.0|120\.1)°\.$/,
  );
  // Mutation: with the other sign of the cosine, or half the lengths of thigh and shin, the bend differs.
  const bend = solveLeg([a, b], 0, at(120)).bend;
  expect(bend).toBeCloseTo(60, 6);
  expect(solveLeg([a / 2, b], 0, at(120)).bend, "mutation").not.toBeCloseTo(bend, 0);
  expect(solveLeg([a, b], 0, at(60)).bend, "mutation").not.toBeCloseTo(bend, 0);
});
