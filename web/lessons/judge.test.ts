import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, describe, expect, test } from "vitest";
import { tablesOf } from "../../scripts/evaluation_plugin.mjs";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { DEFAULT_OPTIONS } from "../client/protocol";
import { serveLearnPackage } from "../engine/learn/wasm";
import { countsOf, typicalOf } from "../figures/judge/histogram_figure";
import { correctionAt, framesOfCorrections, measureJudge, standingOn, trialOf } from "../figures/judge/judge_measure";
import { JUDGE_FIELDS, type JudgeState, METHODS } from "../figures/judge/judge_state";
import { BUILT_IN_OTHER_TAKE, RECORDED, standingOf, steadiest } from "../figures/judge/recorded";
import { createWorldPose, headingOf, JOINT, JOINTS, POSE_FLOATS, worldFromLocal } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./judge";
import { judge as judged } from "./lesson";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();
const PRESET = initialOf(JUDGE_FIELDS);
const DOCUMENT = readFileSync(join(import.meta.dirname, "..", "..", "docs", "evaluation.md"), "utf8");

const exercise = (id: string) => judge.exercises.find((one) => one.id === id)!;
const stateOf = (id: string, patch: Partial<JudgeState>): JudgeState => ({
  ...readHash(JUDGE_FIELDS, exercise(id).start("")),
  ...patch,
});
const measureOf = (id: string, patch: Partial<JudgeState>) => measureJudge(engine, stateOf(id, patch));
const result = async (id: string, patch: Partial<JudgeState>) => judged(exercise(id), await measureOf(id, patch));

describe("the record", () => {
  /** A cell by hand: the line of the section that begins with the method. */
  const cell = (section: string, row: string, column: number) => {
    const text = DOCUMENT.split(`## ${section}\n`)[1]!.split("\n## ")[0]!;
    const line = text.split("\n").find((one) => one.startsWith(`| ${row} |`))!;
    return Number(line.split("|")[column]!.trim());
  };

  test("has the numbers that stand in the document", () => {
    const { inside, off } = RECORDED;
    for (const method of METHODS) {
      const { pose, ...others } = inside.methods.get(method)!;
      expect(pose).toBeCloseTo(10 * cell("One action, every method", method, 2), 9);
      expect(others).toEqual({
        acceleration: cell("One action, every method", method, 7),
        content: cell("One action, every method", method, 8),
      });
    }
    expect(inside.otherTake).toBeCloseTo(10 * cell("One action, every method", "floor: best other take", 2), 9);
    expect(inside.unchanged).toBeCloseTo(10 * cell("One action, every method", "input unchanged", 2), 9);
    expect(BUILT_IN_OTHER_TAKE).toBeCloseTo(10 * cell("The built-in motions", "floor: best other take", 2), 9);
    expect([...off.methods.keys()]).toEqual(["nn", "knn", "lar", "mar"]);
    expect(off.methods.get("mar")).toEqual({
      acceleration: cell("Motion that the database does not hold: methods", "mar", 2),
      content: cell("Motion that the database does not hold: methods", "mar", 3),
    });
  });

  test("is read table by table, whatever else a section says", () => {
    const tables = tablesOf(
      "# T\n\n## One: two, three\nWords | with a bar.\n\n| a | b c |\n| --- | ---: |\n| x |  |\n| y | -1.5 |\n\n## None\nWords.\n",
    );
    expect(tables).toEqual({ oneTwoThree: [{ a: "x" }, { a: "y", "b c": -1.5 }] });
    expect(Object.keys(tablesOf(DOCUMENT)).length).toBeGreaterThan(15);
    expect(standingOf([{ method: "nn", "acceleration ×": 2 }])).toEqual({ methods: new Map() });
  });

  test("off the database one method alone is smooth and keeps its content", () => {
    expect(steadiest(RECORDED.off)).toBe("mar");
    const keeping = [...RECORDED.off.methods].filter(([, { content }]) => content >= 0.8);
    expect(keeping.map(([method]) => method)).toEqual(["mar"]);
  });
});

/** Joints of every frame with the heading removed, and the hips over the origin: frames × joints × xyz. */
function jointsOf(poses: Float32Array, proportions: Float32Array): number[][][] {
  const pose = createWorldPose();
  let heading = 0;
  return Array.from({ length: poses.length / POSE_FLOATS }, (_, frame) => {
    worldFromLocal(proportions, poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS), pose);
    heading = headingOf(pose, heading);
    const p = pose.positions;
    return Array.from({ length: JOINTS }, (_, j) => {
      const [x, y, z] = [p[3 * j]! - p[0]!, p[3 * j + 1]!, p[3 * j + 2]! - p[2]!];
      return [Math.cos(heading) * x - Math.sin(heading) * z, y, Math.sin(heading) * x + Math.cos(heading) * z];
    });
  });
}
const minus = (a: readonly number[], b: readonly number[]) => a.map((value, axis) => value - b[axis]!);
const length = (v: readonly number[]) => Math.sqrt(v.reduce((sum, value) => sum + value * value, 0));
const mean = (values: readonly number[]) => values.reduce((a, b) => a + b, 0) / values.length;

test("error, acceleration and content are those of plain loops over their definitions", async () => {
  const { take, style } = PRESET;
  const motion = await engine.motion({ name: take });
  const truth = jointsOf((await engine.counterpart(take, style))!.poses, motion.proportions);
  const input = jointsOf(motion.poses, motion.proportions);
  for (const method of ["nn", "mar"] as const) {
    const options = { ...DEFAULT_OPTIONS, styles: { [style]: 1 }, method, footplant: false };
    const output = jointsOf((await engine.stylize({ name: take, without: [take] }, options)).poses, motion.proportions);
    const trial = await trialOf(engine, take, style, false, method);
    const fromHips = (frame: number[][]) => frame.slice(1).map((joint) => minus(joint, frame[0]!));
    const errors = output.map((frame, f) => {
      const performed = fromHips(truth[f]!);
      return 1000 * mean(fromHips(frame).map((joint, j) => length(minus(joint, performed[j]!))));
    });
    errors.forEach((error, f) => {
      expect(trial.errors[f]).toBeCloseTo(error, 3);
    });
    expect(trial.pose).toBeCloseTo(mean(errors), 3);
    // Mutations: compared with the performance five frames later, or with one joint fewer in the mean.
    const late = output.slice(0, -5).map((frame, f) => {
      const performed = fromHips(truth[f + 5]!);
      return 1000 * mean(fromHips(frame).map((joint, j) => length(minus(joint, performed[j]!))));
    });
    expect(mean(late) - trial.pose, "mutation").toBeGreaterThan(3);
    expect(trial.pose, "mutation").not.toBeCloseTo((mean(errors) * 20) / 19, 1);
    const acceleration = (motion: number[][][]) =>
      mean(
        motion
          .slice(2)
          .flatMap((frame, f) =>
            frame.map((joint, j) =>
              length(minus(minus(joint, motion[f + 1]![j]!), minus(motion[f + 1]![j]!, motion[f]![j]!))),
            ),
          ),
      );
    expect(trial.acceleration).toBeCloseTo(acceleration(output) / acceleration(input), 3);
    const fast = (motion: number[][][]) => {
      const relative = motion.map(fromHips);
      return relative.flatMap((frame, f) => {
        const around = relative.slice(Math.max(0, f - 15), f + 16);
        return frame.flatMap((joint, j) =>
          joint.map((value, axis) => value - mean(around.map((other) => other[j]![axis]!))),
        );
      });
    };
    const [a, b] = [fast(input), fast(output)];
    const dot = (x: number[], y: number[]) => x.reduce((sum, value, i) => sum + value * y[i]!, 0);
    expect(trial.acceleration, "mutation").not.toBeCloseTo(acceleration(output.slice(0, 100)) / acceleration(input), 2);
    expect(trial.content).toBeCloseTo(dot(a, b) / Math.sqrt(dot(a, a) * dot(b, b)), 4);
  }
});

test("what the line adds is its slopes times the query's distance from the neighbours' mean", async () => {
  const dof = 3 * JOINT.left_lower_leg;
  const settings = { dof, k: 40, lambda: 0.1, noise: 0, taper: true };
  let [looked, mutated] = [0, 0];
  for (const frame of framesOfCorrections(776).filter((_, i) => i % 8 === 0)) {
    const look = { input: { name: "walk-pace", without: ["walk-pace"] }, styles: { old: 1 }, frame };
    const { beta, query, means, bias } = await engine.fit(look, settings);
    if (bias !== 0) continue;
    looked += 1;
    const centres = [means.xPrevious, means.yPrevious, means.x];
    const added = beta.reduce((sum, slope, i) => sum + slope * (query[i]! - centres[i]!), 0);
    expect(await correctionAt(engine, PRESET, frame)).toBeCloseTo((added * 180) / Math.PI, 3);
    // Mutation: slopes times the input itself.
    const whole = beta.reduce((sum, slope, i) => sum + slope * query[i]!, 0);
    mutated += Math.abs(whole - added) * (180 / Math.PI);
  }
  expect(looked).toBeGreaterThan(8);
  expect(mutated / looked, "mutation").toBeGreaterThan(0.5);
});

test("most of what the line adds is less than a tenth of a degree", async () => {
  const values: number[] = [];
  for (const frame of framesOfCorrections(776)) values.push(await correctionAt(engine, PRESET, frame));
  const counts = countsOf(values);
  expect(counts.reduce((a, b) => a + b, 0)).toBe(values.length);
  expect(counts.indexOf(Math.max(...counts)), "the bin around 0").toBe((counts.length - 1) / 2);
  expect(typicalOf(values)).toBeLessThan(0.1);
  expect(countsOf([-7, -0.04, 0.04, 0.06, 9])).toEqual([1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1]);
  expect(typicalOf([3, -1, 2])).toBe(2);
});

test("the methods on the held-out take stand as the record of the built-in motions has them", async () => {
  const { methods, unchanged } = await standingOn(engine, PRESET);
  const pose = (method: (typeof METHODS)[number]) => methods.get(method)!.pose!;
  expect(pose("mar")).toBeLessThan(pose("knn"));
  expect(pose("knn")).toBeLessThan(pose("nn"));
  // As in the text: GAR is the smoothest, and has the largest error.
  for (const standing of [methods, RECORDED.inside.methods]) {
    const all = METHODS.map((method) => standing.get(method)!);
    expect(standing.get("gar")!.pose).toBe(Math.max(...all.map((one) => one.pose!)));
    expect(standing.get("gar")!.acceleration).toBe(Math.min(...all.map((one) => one.acceleration)));
  }
  expect(unchanged).toBeGreaterThan(2 * pose("gar"));
  expect(methods.get("nn")!.acceleration).toBeGreaterThan(2 * methods.get("mar")!.acceleration);
});

test("the bet: hundredths of a millimetre, as the document has them", async () => {
  const { answer, measure } = await judge.bet.reveal(engine);
  expect(answer).toBe("little");
  expect(Number(measure.difference)).toBeGreaterThan(0);
  expect(Number(measure.difference)).toBeLessThan(0.1);
  // As in the reveal: both are as good as a second take, and nearly equal compared with the difference between two
  // takes.
  expect(Math.max(Number(measure.knn), Number(measure.mar))).toBeLessThan(Number(measure.other));
  expect(Number(measure.difference)).toBeLessThan(0.01 * Number(measure.other));
  const text = await TEXTS.en.lessons.judge!();
  const [knn, mar, difference, other] = [measure.knn, measure.mar, measure.difference, measure.other].map((mm) =>
    Number(mm).toFixed(2),
  );
  const said = `KNN’s error is ${knn} mm, MAR’s ${mar} mm: ${difference} mm apart. Even the best other real take is off by ${other} mm`;
  expect(text.bet.reveal(saidIn("en", measure)).startsWith(said)).toBe(true);
});

test("A needs a pin for either, and says which is missing, short or on the wrong side", async () => {
  const [mar, knn] = await Promise.all(
    (["mar", "knn"] as const).map((method) => trialOf(engine, PRESET.take, PRESET.style, false, method)),
  );
  const ahead = Array.from(mar!.errors, (error, f) => knn!.errors[f]! - error);
  const frame = (from: number, to: number) => ahead.findIndex((value) => value >= from && value < to);
  const [forMar, forKnn] = [frame(0.3, 9), frame(-9, -0.3)];
  expect(ahead.filter((value) => value <= -0.3).length, "KNN is ahead in few frames").toBeLessThan(100);
  expect(ahead.filter((value) => value <= -0.3).length).toBeGreaterThan(10);
  const pins = (pickPin: number, rivalPin: number) => result("A", { pickPin, rivalPin });
  expect(await pins(forMar, forKnn)).toEqual({ result: "pass" });
  expect(await result("A", { pick: "knn", rival: "mar", pickPin: forKnn, rivalPin: forMar })).toEqual({
    result: "pass",
  });
  expect(await pins(forMar, -1)).toEqual({ result: "near", way: "noRival" });
  expect(await pins(-1, forKnn)).toEqual({ result: "near", way: "noPick" });
  expect(await pins(frame(0.15, 0.3), forKnn)).toEqual({ result: "near", way: "pick" });
  expect(await pins(forMar, frame(-0.3, -0.15))).toEqual({ result: "near", way: "rival" });
  expect(await pins(forMar, frame(-0.15, 0))).toEqual({ result: "no" });
  expect(await pins(forKnn, forMar)).toEqual({ result: "refuse" });
  expect(await result("A", { pick: "nn", pickPin: forMar })).toEqual({ result: "near", way: "other" });
  expect(await result("A", { leftIn: true, pickPin: forMar, rivalPin: forKnn })).toEqual({
    result: "near",
    way: "other",
  });
  const said = saidIn("en", await measureOf("A", { pickPin: forKnn, rivalPin: forMar }));
  const text = await TEXTS.en.lessons.judge!();
  expect(text.exercises.A!.refuse(said)).toMatch(/^The lower curve is the better one\. .*MAR is ahead by −\d\.\d\d mm/);
});

test("B refuses the number of a method that had seen the answer", async () => {
  const { out, in: left } = await measureOf("B", {});
  expect(Number(left)).toBeLessThan(1);
  expect(Number(out)).toBeGreaterThan(5);
  expect(await result("B", { leftIn: true, honest: "out" })).toEqual({ result: "pass" });
  expect(await result("B", { leftIn: true, honest: "in" })).toEqual({ result: "refuse" });
  expect(await result("B", { leftIn: true })).toEqual({ result: "near", way: "tick" });
  expect(await result("B", { honest: "out" })).toEqual({ result: "near", way: "leave" });
  expect(await result("B", { leftIn: true, honest: "out", take: "walk-turns" })).toEqual({
    result: "near",
    way: "other",
  });
  const said = saidIn("en", await measureOf("B", { leftIn: true, honest: "in" }));
  const [en, de] = [await TEXTS.en.lessons.judge!(), await TEXTS.de.lessons.judge!()];
  expect(en.exercises.B!.refuse(said)).toMatch(/^NN had seen the answer\. 0\.\d\d mm/);
  expect(de.exercises.B!.refuse(saidIn("de", await measureOf("B", {})))).toMatch(
    /^NN hatte die Antwort gesehen\. 0,\d\d mm/,
  );
});

test("C refuses methods that tie inside and jitter outside", async () => {
  for (const pick of ["nn", "knn", "lar"] as const)
    expect(await result("C", { source: "off", pick })).toEqual({ result: "refuse" });
  expect(await result("C", { source: "off", pick: "mar" })).toEqual({ result: "pass" });
  expect(await result("C", { source: "off", pick: "gp" })).toEqual({ result: "near", way: "unmeasured" });
  expect(await result("C", { source: "inside", pick: "mar" })).toEqual({ result: "near", way: "other" });
  expect(await result("C", { source: "live", pick: "mar" })).toEqual({ result: "near", way: "other" });
  const said = saidIn("en", await measureOf("C", { source: "off", pick: "knn" }));
  const text = await TEXTS.en.lessons.judge!();
  expect(text.exercises.C!.refuse(said)).toMatch(/^KNN keeps only 0\.42 of the content, at 3\.31 × the acceleration/);
});
