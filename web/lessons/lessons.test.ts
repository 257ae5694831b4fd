import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import fc from "fast-check";
import { beforeAll, describe, expect, test } from "vitest";
import { FIELDS } from "../app/state/state";
import { piecesOf } from "../app/views/learn/prose";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { serveLearnPackage } from "../engine/learn/wasm";
import { measureBias } from "../figures/bias/bias_measure";
import { BIAS_FIELDS } from "../figures/bias/bias_state";
import { STYLES } from "../figures/built_in";
import { measureChain } from "../figures/chain/chain_measure";
import { CHAIN_FIELDS } from "../figures/chain/chain_state";
import { measureFeet } from "../figures/feet/feet_measure";
import { FEET_FIELDS } from "../figures/feet/feet_state";
import { measureJudge } from "../figures/judge/judge_measure";
import { JUDGE_FIELDS } from "../figures/judge/judge_state";
import type { Measure } from "../figures/kind";
import { LANGUAGES } from "../figures/languages";
import { measureLine } from "../figures/line/line_measure";
import { LINE_FIELDS } from "../figures/line/line_state";
import { measureMap } from "../figures/map/map_measure";
import { MAP_FIELDS } from "../figures/map/map_state";
import { measureMix } from "../figures/mix/mix_measure";
import { MIX_FIELDS } from "../figures/mix/mix_state";
import { measureNear } from "../figures/near/near_measure";
import { NEAR_FIELDS } from "../figures/near/near_state";
import { measurePace } from "../figures/pace/pace_measure";
import { PACE_FIELDS } from "../figures/pace/pace_state";
import { measurePair } from "../figures/pair_measure";
import { PAIR_FIELDS, type PairState } from "../figures/pair_state";
import { measurePose } from "../figures/pose/pose_measure";
import { POSE_FIELDS } from "../figures/pose/pose_state";
import { sharedPair } from "../figures/shared";
import { measureWarp } from "../figures/warp/warp_measure";
import { WARP_FIELDS } from "../figures/warp/warp_state";
import { ROLES } from "../humanoid";
import { readHash, writeHash } from "../link/hash";
import { judge, type Lesson } from "./lesson";
import { LESSONS, lessonOf } from "./lessons";
import { style } from "./style";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();
const root = join(import.meta.dirname, "..", "..");

/** The measure of a state of the first lesson, from its figure. */
async function measured(state: string): Promise<Measure> {
  const pair: PairState = readHash(PAIR_FIELDS, state);
  return measurePair(engine, pair);
}

/** The measures of the other lessons' states. */
const MEASURES: Readonly<Record<string, (state: string) => Promise<Measure>>> = {
  style: measured,
  line: (state) => measureLine(engine, readHash(LINE_FIELDS, state)),
  pose: (state) => measurePose(engine, readHash(POSE_FIELDS, state)),
  register: (state) => measureWarp(engine, readHash(WARP_FIELDS, state)),
  near: (state) => measureNear(engine, readHash(NEAR_FIELDS, state)),
  mix: (state) => measureMix(engine, readHash(MIX_FIELDS, state)),
  bias: (state) => measureBias(engine, readHash(BIAS_FIELDS, state)),
  time: (state) => measurePace(engine, readHash(PACE_FIELDS, state)),
  feet: (state) => measureFeet(engine, readHash(FEET_FIELDS, state)),
  judge: (state) => measureJudge(engine, readHash(JUDGE_FIELDS, state)),
  chain: (state) => measureChain(engine, readHash(CHAIN_FIELDS, state)),
  map: (state) => measureMap(engine, readHash(MAP_FIELDS, state)),
};

const exercise = (id: string) => style.exercises.find((one) => one.id === id)!;
const result = async (id: string, state: Partial<PairState>) =>
  judge(
    exercise(id),
    await measured(writeHash(PAIR_FIELDS, { ...readHash(PAIR_FIELDS, exercise(id).start("")), ...state })),
  );

describe("every lesson", () => {
  test.each(LESSONS)("$id is complete in every language", async ({ id, load }) => {
    const lesson = await load();
    expect(lesson.id).toBe(id);
    for (const language of LANGUAGES) {
      const text = await TEXTS[language].lessons[id]!();
      expect(Object.keys(text.symbols)).toEqual([...lesson.symbols]);
      expect(Object.keys(text.bet.options)).toEqual([...lesson.bet.options]);
      expect(Object.keys(text.exercises)).toEqual(lesson.exercises.map((one) => one.id));
      const terms = new Set([...lesson.equation.matchAll(/data-term="(\w+)"/g)].map(([, term]) => term));
      for (const term of terms) expect(lesson.symbols, "a symbol of the equation has a button").toContain(term);
      // KaTeX's other families are left out of the page: `scripts/katex_plugin.mjs`.
      expect(lesson.equation).not.toMatch(/"mord (mathbf|mathcal|mathbb|amsrm|boldsymbol|mathsf)|delimsizing size4/);
      const exercises = Object.values(text.exercises).flatMap(({ task, hints }) => [task, ...hints]);
      const said = [...text.idea, text.bet.question, ...text.look, text.why, ...exercises, ...text.sources];
      for (const { term } of said.flatMap(piecesOf)) if (term) expect(lesson.symbols).toContain(term);
      const named = text.sources.map((source) => piecesOf(source).filter(({ kind }) => kind === "code"));
      expect(named.flat().length).toBeGreaterThan(0);
      for (const codes of named) {
        const [files, names] = [true, false].map((isFile) => codes.filter(({ text }) => text.includes("/") === isFile));
        for (const { text } of files!) expect(existsSync(join(root, text)), text).toBe(true);
        // A name is next to its file.
        const sources = files!.map(({ text }) => readFileSync(join(root, text), "utf8")).join();
        for (const { text } of names!) expect(sources, text).toContain(text);
      }
    }
  });

  test.each(LESSONS)("$id keeps its keys apart from the page's", async ({ load }) => {
    const page = new Set(Object.values(FIELDS).map(({ key }) => key));
    for (const key of (await load()).keys) expect(page.has(key), key).toBe(false);
  });

  test.each(LESSONS)("$id: each solution passes, and its link says it again", async ({ load }) => {
    const lesson = await load();
    for (const one of lesson.exercises) {
      const state = await one.solve(engine);
      expect(lesson.clean(state)).toBe(state);
      const measure = MEASURES[lesson.id]!;
      expect(judge(one, await measure(state)), one.id).toEqual({ result: "pass" });
      expect(judge(one, await measure(one.start(""))).result, `${one.id} is not solved at the start`).not.toBe("pass");
    }
  });

  test("the teachers' page has them all", () => {
    const page = readFileSync(join(root, "docs", "teaching.md"), "utf8");
    for (const { id } of LESSONS) expect(page).toContain(`\`${id}\`: `);
  });

  test("an unknown one is the first", () => {
    expect(lessonOf("no such lesson")).toBe(LESSONS[0]);
  });

  test("has markup that the page's policy allows", () => {
    expect(style.equation).toContain("<math");
    expect(style.equation).not.toMatch(/ style=|<script/);
  });

  test("each language is a folder", () => {
    expect(
      readdirSync(join(import.meta.dirname, "text"), { withFileTypes: true })
        .filter((e) => e.isDirectory())
        .map((e) => e.name)
        .sort(),
    ).toEqual([...LANGUAGES].sort());
  });
});

describe("style", () => {
  test("the bet: the clock shows more difference", async () => {
    const { answer, measure } = await style.bet.reveal(engine);
    expect(answer).toBe("second");
    expect(Number(measure.second)).toBeGreaterThan(Number(measure.content));
  });

  test("A: one style passes", async () => {
    const passing: string[] = [];
    for (const name of STYLES) if ((await result("A", { style: name })).result === "pass") passing.push(name);
    expect(passing).toEqual(["sexy"]);
    // By hand: the mean over the frames.
    const meanOfStyle = async (name: string) => {
      const { content } = (await sharedPair(engine, "neutral walk", name))!.difference;
      let sum = 0;
      for (let f = 0; f < content.length; f++) sum += content[f]!;
      return sum / content.length;
    };
    const { meanContent } = await measured("style=sexy");
    expect(meanContent).toBeCloseTo(await meanOfStyle("sexy"), 6);
    expect(Math.abs((await meanOfStyle("childlike")) - Number(meanContent)), "mutation: next style").toBeGreaterThan(
      0.1,
    );
  });

  test("A refuses the style that is nearest by the clock, and says so", async () => {
    expect(await result("A", { style: "childlike" })).toEqual({ result: "refuse" });
    for (const name of ["proud", "old"] as const) expect(await result("A", { style: name })).toEqual({ result: "no" });
    expect(await result("A", { style: "neutral" })).toEqual({ result: "near", way: "other" });
    expect(await result("A", { style: "sexy", motion: "neutral run" })).toEqual({ result: "near", way: "other" });
    const said = saidIn("en", await measured("style=childlike"));
    const text = await TEXTS.en.lessons.style!();
    expect(text.exercises.A!.refuse(said)).toMatch(
      /^You compared different moments of the step\. .*childlike.* 11\.71 cm.* 5\.70 cm/,
    );
    const german = await TEXTS.de.lessons.style!();
    expect(german.exercises.A!.refuse(saidIn("de", await measured("style=childlike")))).toMatch(
      /^Du hast verschiedene Augenblicke .*kindlich den kleinsten Unterschied, 11,71 cm; .* 5,70 cm/,
    );
  });

  test("B is passed in some stretches of the sexy walk only, and says which way", async () => {
    expect(await result("B", {})).toEqual({ result: "refuse" });
    const other = { result: "near", way: "other" };
    for (const state of [{ style: "proud" }, { motion: "neutral run" }, { joint: "head" }] as const)
      expect(await result("B", { at: 160, ...state })).toEqual(other);
    const text = await TEXTS.en.lessons.style!();
    expect(text.exercises.B!.refuse({})).toMatch(/^Here the two are in step: the same second is the same content/);
    const pair = (await sharedPair(engine, "neutral walk", "sexy"))!;
    const passing: number[] = [];
    for (let at = 0; at < pair.input.frames; at++)
      if (pair.difference.second[at]! >= 4 * pair.difference.content[at]!) passing.push(at);
    expect(passing.length).toBeGreaterThan(60);
    expect(passing.length).toBeLessThan(300);
    expect(await result("B", { at: passing[10]! })).toEqual({ result: "pass" });
    const first = passing[0]!;
    expect(await result("B", { at: first - 1 })).toEqual({ result: "near", way: "later" });
    const last = passing.find((at) => !passing.includes(at + 1))!;
    expect(await result("B", { at: last + 2 })).toEqual({ result: "near", way: "earlier" });
    expect(await result("B", { at: 70 })).toEqual({ result: "no" });
    // As in the hint: one step, half a neutral cycle, late, and later two.
    const cycle = 65 / 60;
    const late = (at: number) => pair.styled.timeOut[at]! - at / 60;
    expect(late(230)).toBeCloseTo(cycle / 2, 1);
    expect(late(464)).toBeCloseTo(cycle, 1);
  });

  test("C refuses the legs, and is close at the neck", async () => {
    expect(await result("C", { joint: "left_foot" })).toEqual({ result: "refuse" });
    expect(await result("C", { joint: "neck" })).toEqual({ result: "near", way: "close" });
    expect(await result("C", { joint: "hips" })).toEqual({ result: "no" });
    expect(await result("C", {})).toEqual({ result: "near", way: "none" });
    expect(await result("C", { joint: "head", style: "proud" })).toEqual({ result: "near", way: "other" });
    expect(await result("C", { joint: "head", motion: "neutral run" })).toEqual({ result: "near", way: "other" });
    const passing: string[] = [];
    for (const joint of ROLES) if ((await result("C", { joint })).result === "pass") passing.push(joint);
    expect(passing).toEqual(["head"]);
    const [text, german] = [await TEXTS.en.lessons.style!(), await TEXTS.de.lessons.style!()];
    const toes = await measured("joint=left_toes");
    expect(text.exercises.C!.refuse(saidIn("en", toes))).toMatch(
      /^The legs move most in every walk.* toes L by 2\d\.\d\d cm\. .* At equal instants it is 9\.\d\d cm\.$/,
    );
    expect(german.exercises.C!.refuse(saidIn("de", toes))).toMatch(/Zehen L um 2\d,\d\d cm.* sind es 9,\d\d cm\.$/);
  });
});

describe("states of figures", () => {
  const isStable = (lesson: Lesson, text: string) => lesson.clean(lesson.clean(text)) === lesson.clean(text);

  test("survive being written and read", () => {
    fc.assert(
      fc.property(
        fc.integer({ min: -10, max: 9999 }),
        fc.constantFrom("old", "sexy", "x"),
        fc.constantFrom("content", "second", "?"),
        (at, name, pair) => {
          const state = readHash(PAIR_FIELDS, `i=${at}&style=${name}&pair=${pair}`);
          expect(state.at).toBe(Math.min(5000, Math.max(0, at)));
          expect(readHash(PAIR_FIELDS, writeHash(PAIR_FIELDS, state))).toEqual(state);
        },
      ),
    );
  });

  test.each(LESSONS)("$id: anything else is left out", async ({ load }) => {
    const lesson = await load();
    fc.assert(fc.property(fc.string(), (text) => isStable(lesson, text)));
    const pair = fc.tuple(
      fc.constantFrom(...lesson.keys, "K", "__proto__"),
      fc.oneof(fc.string(), fc.double().map(String)),
    );
    fc.assert(fc.property(fc.array(pair), (pairs) => isStable(lesson, new URLSearchParams(pairs).toString())));
  });

  test("what is out of range is brought into it, and an unknown name is passed over", () => {
    expect(style.clean("K=12&style=<b>&i=1e99&joint=__proto__&pair=content&motion=neutral%20run")).toBe(
      "motion=neutral%20run&pair=content&i=5000",
    );
    expect(readHash(PAIR_FIELDS, "i=160.5").at).toBe(161);
  });
});
