import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { serveLearnPackage } from "../engine/learn/wasm";
import { LANGUAGES, WORDS } from "../figures/languages";
import { align, positionsOf, WEIGHTS } from "../figures/near/alignment";
import { distanceOf, foundOf, measureNear } from "../figures/near/near_measure";
import { changeOf, DRAWN, lookOf, NEAR_FIELDS, type NearState } from "../figures/near/near_state";
import { JOINT, type Role } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { near } from "./near";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(NEAR_FIELDS);
const exercise = (id: string) => near.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<NearState>) =>
  judge(exercise(id), await measureNear(engine, { ...readHash(NEAR_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: a turn and a move change nothing", async () => {
  const { answer, measure } = await near.bet.reveal(engine);
  expect(answer).toBe("same");
  expect(Number(measure.before)).toBeGreaterThan(1);
});

test("the distance of one frame is what is left after the best of many turns and shifts", async () => {
  const { proportions } = await engine.motion({ name: PRESET.motion });
  const state: NearState = {
    ...PRESET,
    window: "1",
    heading: 70,
    x: 0.4,
    turned: [{ joint: "left_upper_arm", by: [0, 0, 30] }],
  };
  const found = await foundOf(engine, state);
  const row = found.firstRow + found.order[0]!;
  const pose = await engine.rowPoses([row]);
  const other = await engine.rowPoses([found.firstRow + found.order[40]!]);
  const [query, nearest, another] = [found.query, pose, other].map((one) => positionsOf(one, proportions)) as [
    Float32Array,
    Float32Array,
    Float32Array,
  ];
  const points = Object.entries(WEIGHTS).map(([role, weight]) => [3 * JOINT[role as Role], weight] as const);
  /** D at a rotation; the best translation for it aligns the centres. */
  const at = (turn: number, weighted = points, example = nearest) => {
    const points = weighted;
    const total = points.reduce((sum, [, weight]) => sum + weight, 0);
    const turned = (i: number) => [
      Math.cos(turn) * example[i]! + Math.sin(turn) * example[i + 2]!,
      example[i + 1]!,
      Math.cos(turn) * example[i + 2]! - Math.sin(turn) * example[i]!,
    ];
    const differences = points.map(([i, weight]) => {
      const [x, y, z] = turned(i) as [number, number, number];
      return { weight, x: query[i]! - x, y: query[i + 1]! - y, z: query[i + 2]! - z };
    });
    const mean = (of: "x" | "z") => differences.reduce((sum, one) => sum + one.weight * one[of], 0) / total;
    const [x, z] = [mean("x"), mean("z")];
    return differences.reduce((sum, d) => sum + d.weight * ((d.x - x) ** 2 + d.y ** 2 + (d.z - z) ** 2), 0) / total;
  };
  const leastOf = (...given: [weighted?: typeof points, example?: Float32Array]) => {
    let least = Number.POSITIVE_INFINITY;
    for (let step = 0; step < 3600; step++) least = Math.min(least, at((step * Math.PI) / 1800, ...given));
    return least;
  };
  const least = leastOf();
  expect(distanceOf(found, 0)).toBeCloseTo(Math.sqrt(least), 5);
  const { heights, ground, turn } = align(query, pose, proportions);
  expect(Math.sqrt(heights + ground)).toBeCloseTo(Math.sqrt(least), 5);
  expect(at(turn)).toBeCloseTo(heights + ground, 8);
  const off = (value: number) => Math.abs(Math.sqrt(value) - distanceOf(found, 0));
  expect(off(leastOf(points, another)), "mutation: another row").toBeGreaterThan(1e-3);
  expect(off(leastOf(points.slice(0, 8))), "mutation: legs alone").toBeGreaterThan(1e-3);
  expect(off(at(turn + 0.1)), "mutation: another turn").toBeGreaterThan(1e-3);
});

test("neighbours stand in the order in which the engine finds them", async () => {
  const found = await foundOf(engine, PRESET);
  const { rows, distances } = await engine.neighbours(lookOf(PRESET), 30, { query: changeOf(PRESET) });
  expect(Array.from(found.order.subarray(0, 30), (at) => found.firstRow + at)).toEqual([...rows]);
  for (const [i, distance] of distances.entries()) expect(distanceOf(found, i)).toBeCloseTo(distance, 6);
});

test("K is counted by hand", async () => {
  const count = async (state: NearState, times: number) => {
    const { distances } = await foundOf(engine, state);
    let [least, within] = [Number.POSITIVE_INFINITY, 0];
    for (const distance of distances) if (distance < least) least = distance;
    for (const distance of distances) if (distance <= times * least) within += 1;
    return within;
  };
  expect(await count(PRESET, 2)).toBe(22);
  expect(await count(PRESET, Math.SQRT2), "mutation: squares").toBeLessThan(10);
  expect(Math.abs((await count({ ...PRESET, at: 190 }, 2)) - 22), "mutation: another frame").toBeGreaterThan(2);
});

test("what moves the query changes nothing, and what bends it does", async () => {
  const bent: NearState = { ...PRESET, turned: [{ joint: "left_upper_arm", by: [0, 0, 30] }] };
  const [before, moved, changed] = await Promise.all(
    [PRESET, { ...PRESET, heading: 90, x: 1 }, bent].map((state) => measureNear(engine, state)),
  );
  expect(moved!.first).toBeCloseTo(Number(before!.first), 2);
  expect(Number(changed!.first) - Number(before!.first), "mutation: a bent arm").toBeGreaterThan(10);
});

test("the text's constants are the engine's", async () => {
  const metric = readFileSync(join(import.meta.dirname, "../../rust/strut-core/src/search/metric.rs"), "utf8");
  expect(PRESET.window).toBe(/const WINDOW: usize = (\d+);/.exec(metric)![1]);
  const words = { en: { window: "five", drawn: "8 nearest" }, de: { window: "fünf", drawn: "8 nächsten" } };
  expect([PRESET.window, DRAWN]).toEqual(["5", 8]);
  for (const language of LANGUAGES) {
    const { idea, look } = await TEXTS[language].lessons.near!();
    expect(idea.join(" ")).toContain(words[language].window);
    expect(look.join(" ")).toContain(words[language].drawn);
    expect(WORDS[language].near.stage).toContain(words[language].drawn);
    expect(look.join(" ")).toContain(`${Object.keys(WEIGHTS).length} `);
  }
  expect(near.equation).toContain("20");
});

test("A is passed by one K alone", async () => {
  const passing: number[] = [];
  for (let k = 1; k <= 60; k++) if ((await result("A", { k })).result === "pass") passing.push(k);
  expect(passing).toEqual([22]);
  expect(await result("A", { k: 20 })).toEqual({ result: "near", way: "more" });
  expect(await result("A", { k: 23 })).toEqual({ result: "near", way: "less" });
  expect(await result("A", { k: 40 })).toEqual({ result: "no" });
  expect(await result("A", { k: 22, window: "9" })).toEqual({ result: "near", way: "other" });
  expect((await result("A", { k: 22, heading: 90, x: 1 })).result).toBe("pass");
});

test("A refuses squares", async () => {
  const refused: number[] = [];
  for (let k = 1; k <= 60; k++) if ((await result("A", { k })).result === "refuse") refused.push(k);
  expect(refused).toHaveLength(1);
  const text = await TEXTS.en.lessons.near!();
  const measure = await measureNear(engine, { ...PRESET, k: refused[0]! });
  expect(text.exercises.A!.refuse(saidIn("en", measure))).toMatch(
    /^You compared D, which is squared: with K \d+, D doubles/,
  );
  const german = await TEXTS.de.lessons.near!();
  expect(german.exercises.A!.refuse(saidIn("de", measure))).toMatch(/^Du hast D verglichen, das quadriert ist: Mit K/);
});

test("B wants a move, and then nothing", async () => {
  const { change } = await measureNear(engine, { ...PRESET, heading: -90, z: -0.6 });
  expect(Number(change)).toBeLessThan(0.01);
  expect(await result("B", { guess: 0 })).toEqual({ result: "near", way: "further" });
  expect(await result("B", { heading: 90, x: 0.3, guess: 0 })).toEqual({ result: "near", way: "further" });
  expect(await result("B", { heading: -90, z: -0.6 })).toEqual({ result: "near", way: "none" });
  expect(await result("B", { heading: -90, z: -0.6, guess: 0.05 })).toEqual({ result: "pass" });
  expect(await result("B", { heading: -90, z: -0.6, guess: 0.09 })).toEqual({ result: "pass" });
  for (const guess of [0.1, 0.5, 600])
    expect(await result("B", { heading: -90, z: -0.6, guess })).toEqual({ result: "refuse" });
  const { exercises } = await TEXTS.en.lessons.near!();
  const wrong = await measureNear(engine, { ...PRESET, heading: -90, z: -0.6, guess: 600 });
  expect(exercises.B!.refuse(saidIn("en", wrong))).toMatch(
    /^You entered 600\.00 mm, but √D₁ changed by 0\.00 mm: the best turn and shift undo your move\.$/,
  );
  const bent: NearState["turned"] = [{ joint: "left_upper_arm", by: [0, 0, 30] }];
  expect(await result("B", { heading: -90, z: -0.6, guess: 0, turned: bent })).toEqual({
    result: "near",
    way: "other",
  });
});

test("C: one frame has no direction, and five have", async () => {
  expect(await result("C", {})).toEqual({ result: "near", way: "forward" });
  expect(await result("C", { reversed: true })).toEqual({ result: "refuse" });
  expect(await result("C", { reversed: true, window: "5" })).toEqual({ result: "pass" });
  expect(await result("C", { reversed: true, window: "15" })).toEqual({ result: "near", way: "shorter" });
  const { backwards1, backwards5 } = await measureNear(engine, PRESET);
  expect(backwards1).toBeCloseTo(1, 6);
  expect(backwards5).toBeGreaterThan(8);
  for (const state of [{ motion: "neutral run" }, { at: 200 }] as const)
    expect(await result("C", { reversed: true, window: "5", ...state })).toEqual({ result: "near", way: "other" });
  const [text, german] = [await TEXTS.en.lessons.near!(), await TEXTS.de.lessons.near!()];
  expect(text.exercises.C!.refuse({})).toMatch(/^At s = 1 both directions have the same poses/);
  expect(german.exercises.C!.refuse({})).toMatch(/^Bei s = 1 sind es in beiden Richtungen dieselben Posen/);
});
