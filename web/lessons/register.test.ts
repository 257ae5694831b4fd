import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { serveLearnPackage } from "../engine/learn/wasm";
import { LANGUAGES, WORDS } from "../figures/languages";
import { measureWarp } from "../figures/warp/warp_measure";
import { WARP_FIELDS, type WarpState } from "../figures/warp/warp_state";
import { costAt, costRatio, feetAt, MAX_PACE, msOff, ownPath, type Warping, warpingOf } from "../figures/warp/warping";
import { formatNumber } from "../figures/words/words";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { register } from "./register";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(WARP_FIELDS);
const exercise = (id: string) => register.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<WarpState>) =>
  judge(exercise(id), await measureWarp(engine, { ...readHash(WARP_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: the straight line is nearer to the truth than the cheapest path", async () => {
  const { answer, measure } = await register.bet.reveal(engine);
  expect(answer).toBe("straight");
  expect(Number(measure.dtw)).toBeGreaterThan(4 * Number(measure.linear));
});

/** The lowest cost of all paths by the recurrence of the lesson, for every pair of frames from the ends. */
function leastCost({ costs, neutral: { frames: n }, styled: { frames: m } }: Warping): number {
  const c = (i: number, j: number) => (i < 0 || j < 0 ? Number.POSITIVE_INFINITY : costs[i * m + j]!);
  const total = new Map<string, number>();
  const C = (i: number, j: number): number => {
    if (i === 0 && j === 0) return c(0, 0);
    if (i < 0 || j < 0) return Number.POSITIVE_INFINITY;
    const key = `${i} ${j}`;
    const known = total.get(key);
    if (known !== undefined) return known;
    let least = C(i - 1, j - 1);
    for (const s of [2, 3]) {
      let [across, up] = [C(i - s, j - 1), C(i - 1, j - s)];
      for (let r = 1; r < s; r++) {
        across += c(i - r, j);
        up += c(i, j - r);
      }
      least = Math.min(least, across, up);
    }
    total.set(key, c(i, j) + least);
    return c(i, j) + least;
  };
  return C(n - 1, m - 1);
}

test("DTW's path costs what the recurrence says is the least", async () => {
  const warping = await warpingOf(engine, "old");
  const { dtw } = warping.paths;
  let cost = costAt(warping, 0, 0);
  for (let i = 1; i < dtw.length; i++) {
    // A steep path passes several frames of the style's step in one of the neutral step's.
    for (let j = Math.round(dtw[i - 1]!) + 1; j <= Math.round(dtw[i]!); j++) cost += costAt(warping, i, j);
    if (Math.round(dtw[i]!) === Math.round(dtw[i - 1]!)) cost += costAt(warping, i, dtw[i]!);
  }
  const least = leastCost(warping);
  expect(least).toBeGreaterThan(0);
  // The engine's path between whole frames is rounded.
  expect(cost / least).toBeGreaterThan(0.98);
  expect(cost / least).toBeLessThan(1.1);
  let straight = costAt(warping, 0, 0);
  for (let i = 1; i < dtw.length; i++) {
    const [before, now] = [warping.paths.linear[i - 1]!, warping.paths.linear[i]!];
    for (let j = Math.round(before) + 1; j <= Math.round(now); j++) straight += costAt(warping, i, j);
  }
  expect(straight / least, "mutation: the straight path").toBeGreaterThan(1.4);
});

test("the cost of a path is c as often as it passes frames", async () => {
  const warping = await warpingOf(engine, "old");
  const total = (path: ArrayLike<number>, shift = 0) => {
    let sum = 0;
    for (let i = 0; i < path.length; i++) {
      const at = Math.min(warping.styled.frames - 1, path[i]! + shift);
      const j = Math.min(warping.styled.frames - 2, Math.floor(at));
      const row = i * warping.styled.frames;
      const c = warping.costs[row + j]! * (1 - (at - j)) + warping.costs[row + j + 1]! * (at - j);
      sum += c * Math.max(1, i > 0 ? path[i]! - path[i - 1]! : 1);
    }
    return sum;
  };
  const own = ownPath(warping, PRESET.anchors);
  const { cost, off } = await measureWarp(engine, PRESET);
  expect(cost).toBeCloseTo(total(own) / total(warping.paths.dtw), 4);
  expect(Math.abs(Number(cost) - total(own, 6) / total(warping.paths.dtw)), "mutation: later").toBeGreaterThan(0.1);
  let [sum, shifted] = [0, 0];
  for (let i = 0; i < own.length; i++) {
    sum += Math.abs(own[i]! - warping.paths.exact[i]!);
    shifted += Math.abs(own[i]! - warping.paths.exact[Math.min(own.length - 1, i + 3)]!);
  }
  const ms = (frames: number) => (1000 * frames) / own.length / warping.rateHz;
  expect(Number(off)).toBe(Math.round(ms(sum)));
  expect(Math.abs(Number(off) - ms(shifted)), "mutation: another frame").toBeGreaterThan(20);
});

test("a frame costs nothing with itself", async () => {
  const cycle = (await engine.clips("walk")).find(({ name }) => name === "walk-pace_neutral")!.cycles[2]!;
  const { costs } = await engine.register("walk", cycle, cycle, "dtw");
  const frames = Math.sqrt(costs.length);
  for (let i = 0; i < frames; i++) {
    expect(costs[i * frames + i]).toBeCloseTo(0, 6);
    expect(costs[i * frames + ((i + 20) % frames)], "mutation: another frame").toBeGreaterThan(1);
  }
});

test("the text's constants are the engine's", async () => {
  const source = (file: string) =>
    readFileSync(join(import.meta.dirname, "../../rust/strut-core/src/registration", file), "utf8");
  const constant = (file: string, name: string) =>
    Number(new RegExp(`const ${name}: \\w+ = ([\\d.]+);`).exec(source(file))![1]);
  expect(MAX_PACE).toBe(constant("dtw.rs", "MAX_SLOPE"));
  const { rateHz, neutral, styled } = await warpingOf(engine, "old");
  const lambda = (constant("imw.rs", "SMOOTHNESS_SECS") * rateHz) ** 2;
  const pull = constant("imw.rs", "PULL");
  for (const language of LANGUAGES) {
    const text = await TEXTS[language].lessons.register!();
    const number = (value: number, digits: number) => formatNumber(value, digits, WORDS[language]);
    const look = text.look.join(" ");
    expect(look).toContain(`λ = ${number(lambda, 0)}`);
    expect(look).toContain(`μ = ${number(pull, 1)}`);
    for (const { frames } of [neutral, styled]) expect(text.idea[0]).toContain(`${number(frames / rateHz, 1)} s`);
    expect(text.exercises.A!.task).toContain(number(1.2, 1));
  }
});

test("the straight path is a straight line, and the distance from the truth a mean", async () => {
  const warping = await warpingOf(engine, "old");
  const { linear, exact } = warping.paths;
  linear.forEach((at, i) => {
    if (Math.abs(at - (i * (warping.styled.frames - 1)) / (linear.length - 1)) > 1e-3) throw new Error(`frame ${i}`);
  });
  let sum = 0;
  for (let i = 0; i < linear.length; i++) sum += Math.abs(linear[i]! - exact[i]!);
  expect(msOff(warping, linear)).toBeCloseTo((1000 * sum) / linear.length / 60, 6);
  expect(costRatio(warping, ownPath(warping, PRESET.anchors))).toBeCloseTo(costRatio(warping, linear), 2);
});

test("A wants a cheap path, not the true one", async () => {
  expect((await result("A", {})).result).toBe("no");
  const warping = await warpingOf(engine, "old");
  const along = (path: Float32Array, shares: readonly number[]) =>
    shares.map((x) => ({ x, y: path[Math.round(x * (path.length - 1))]! / (warping.styled.frames - 1) }));
  const { dtw, exact } = warping.paths;
  expect(await result("A", { anchors: along(exact, [0.25, 0.5, 0.75]) })).toEqual({ result: "refuse" });
  const { anchors } = readHash(WARP_FIELDS, await exercise("A").solve(engine));
  const bent = (by: number) => anchors.map(({ x, y }, i) => ({ x, y: i === 1 ? y + by : y }));
  const least = Number((await measureWarp(engine, { ...PRESET, anchors })).cost);
  expect(least).toBeGreaterThan(1);
  expect(least).toBeLessThan(1.1);
  const ways = new Map<string, number>();
  for (let by = -20; by <= 20; by++) {
    const found = await result("A", { anchors: bent(by / 100) });
    if (found.result === "near") ways.set(found.way, by);
  }
  expect(ways.get("up")).toBeLessThan(0);
  expect(ways.get("down")).toBeGreaterThan(0);
  // Each point may be off by a hundredth of the steps.
  for (const which of [0, 1, 2])
    for (const [x, y] of [
      [0.01, 0],
      [-0.01, 0],
      [0, 0.01],
      [0, -0.01],
    ] as const) {
      const off = anchors.map((one, i) => (i === which ? { x: one.x + x, y: one.y + y } : one));
      expect((await result("A", { anchors: off })).result).toBe("pass");
    }
  expect(dtw.length).toBe(exact.length);
  expect(await result("A", { style: "proud" })).toEqual({ result: "near", way: "other" });
  const text = await TEXTS.en.lessons.register!();
  expect(text.exercises.A!.no(saidIn("en", await measureWarp(engine, PRESET)))).toMatch(
    /^1\.74 times the cost of DTW\. Most of the extra cost is from \d+ to \d+ ms\.$/,
  );
  const true3 = await measureWarp(engine, { ...PRESET, path: "own", anchors: along(exact, [0.25, 0.5, 0.75]) });
  expect(text.exercises.A!.refuse(saidIn("en", true3))).toMatch(
    /^Your path is only \d ms from the truth, but it costs 1\.\d\d times as much as DTW’s\./,
  );
  const german = await TEXTS.de.lessons.register!();
  expect(german.exercises.A!.refuse(saidIn("de", true3))).toMatch(
    /^Dein Pfad ist nur \d ms von der Wahrheit entfernt, kostet aber das 1,\d\d-Fache von DTW\./,
  );
});

test("B is passed where DTW mends the feet", async () => {
  const warping = await warpingOf(engine, "old");
  const { linear, dtw } = warping.paths;
  const passing: number[] = [];
  for (let at = 0; at < warping.neutral.frames; at++) {
    const same = (path: Float32Array) =>
      String(feetAt(warping.neutral, at)) === String(feetAt(warping.styled, path[at]!));
    const { result: found } = await result("B", { at });
    expect(found === "pass").toBe(!same(linear) && same(dtw));
    if (found === "pass") passing.push(at);
  }
  expect(passing).toEqual([12, 13, 14, 44, 45, 46]);
  expect(await result("B", { at: passing[0]! - 2 })).toEqual({ result: "near", way: "later" });
  expect(await result("B", { at: 47 })).toEqual({ result: "near", way: "earlier" });
  expect(await result("B", { at: 30 })).toEqual({ result: "no" });
  expect(await result("B", { at: passing[0]!, style: "sexy" })).toEqual({ result: "near", way: "other" });
});

test("B refuses an instant at which feet differ under both", async () => {
  const refused: number[] = [];
  for (let at = 0; at < 65; at++) if ((await result("B", { at })).result === "refuse") refused.push(at);
  expect(refused.length).toBeGreaterThan(0);
  expect(await result("B", { at: refused[0]!, style: "sexy" })).toEqual({ result: "near", way: "other" });
  const said = await measureWarp(engine, { ...PRESET, at: refused[0]! });
  const [text, german] = [await TEXTS.en.lessons.register!(), await TEXTS.de.lessons.register!()];
  expect(text.exercises.B!.refuse(saidIn("en", said))).toMatch(/^At \d+ ms DTW pairs different feet, too/);
  expect(german.exercises.B!.refuse(saidIn("de", said))).toMatch(/^Bei \d+ ms stehen auch bei DTW verschiedene Füße/);
});
