import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import type { JointPath } from "../client/learn/protocol";
import { serveLearnPackage } from "../engine/learn/wasm";
import { loadBuiltInWalkModel } from "../engine/walk/built_in";
import {
  cadenceOf,
  farthest,
  farthestDeviations,
  framesOf,
  jerkOf,
  measureChain,
  pathOf,
  STATES,
  WALK_HZ,
} from "../figures/chain/chain_measure";
import { CHAIN_FIELDS, type ChainState } from "../figures/chain/chain_state";
import { DEGREES, JOINT, POSE_FLOATS } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { chain } from "./chain";
import { judge } from "./lesson";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(CHAIN_FIELDS);
const exercise = (id: string) => chain.exercises.find((one) => one.id === id)!;
const said = async (language: "en" | "de", id: string, patch: Partial<ChainState>) =>
  saidIn(
    language,
    await measureChain(engine, { ...readHash(CHAIN_FIELDS, exercise(id).start("")), ...patch }),
    chain.decimals,
  );
const result = async (id: string, patch: Partial<ChainState>) =>
  judge(exercise(id), await measureChain(engine, { ...readHash(CHAIN_FIELDS, exercise(id).start("")), ...patch }));

test("the bet: a firmer promise about the change of change is smoother", async () => {
  const { answer, measure } = await chain.bet.reveal(engine);
  expect(answer).toBe("smoother");
  expect(Number(measure.toes)).toBeLessThan(0.6);
});

test("measures of a curve are those of its definition", () => {
  const path: JointPath = {
    c: Float32Array.of(0, 0, 0, 6, 0),
    mean: Float32Array.of(0, 1, 0, 2, 0),
    deviation: Float32Array.of(1, 1, 1, 2, 1),
    state: Uint8Array.of(0, 1, 2, 3, 4),
    side: new Uint8Array(5),
    durations: Float32Array.of(1, 2, 3, 4, 5, 6, 7, 8, 9, 10),
  };
  expect(farthest(path)).toBeCloseTo(4 * DEGREES, 5);
  // Deviations of the model: with the factor 4 the displayed ones are twice as large.
  expect(farthestDeviations(path, 4)).toBeCloseTo(4, 6);
  // Third differences 6 and −18.
  expect(jerkOf(path)).toBeCloseTo(12 * DEGREES, 4);
  // Mutations: a mean of another frame, or σ² twice as large, gives another measure.
  expect(farthest({ ...path, mean: path.mean.slice().reverse() }), "mutation").not.toBeCloseTo(4 * DEGREES, 0);
  expect(farthestDeviations(path, 2), "mutation").not.toBeCloseTo(4, 0);
  expect(framesOf(path)).toEqual([15, 40]);
  expect(cadenceOf(path)).toBeCloseTo((2 * 60 * 30) / 55, 6);
});

test("a step has five states in order, and frames as many as they last", async () => {
  const path = await pathOf(engine, PRESET);
  const [left, right] = framesOf(path);
  expect(Math.abs(path.c.length - left - right)).toBeLessThanOrEqual(1);
  expect(new Set(path.state).size).toBe(STATES);
  path.state.forEach((state, i) => {
    if (i > 0 && path.side[i] === path.side[i - 1]) expect(state).toBeGreaterThanOrEqual(path.state[i - 1]!);
  });
});

/** The numbers of the walk model's file: a header with the position of each array, and the arrays. */
async function modelFile() {
  const file = await loadBuiltInWalkModel();
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const length = Number(view.getBigUint64(0, true));
  const header = JSON.parse(new TextDecoder().decode(file.subarray(8, 8 + length)));
  const numbers = (name: string) => {
    const [from, to] = header[name].data_offsets as [number, number];
    return Array.from({ length: (to - from) / 4 }, (_, i) => view.getFloat32(8 + length + from + 4 * i, true));
  };
  const styles = JSON.parse(Object.values<string>(header.__metadata__)[0]!).styles as string[];
  return { styles, means: numbers("means"), variances: numbers("variances") };
}

/** Solves a dense system by Gaussian elimination. */
function solved(a: number[][], b: number[]): number[] {
  const rows = a.map((row, i) => [...row, b[i]!]);
  const n = rows.length;
  for (let k = 0; k < n; k++) {
    for (let i = k + 1; i < n; i++) {
      const share = rows[i]![k]! / rows[k]![k]!;
      if (share !== 0) for (let c = k; c <= n; c++) rows[i]![c]! -= share * rows[k]![c]!;
    }
  }
  const x = new Array<number>(n).fill(0);
  for (let k = n - 1; k >= 0; k--) {
    let known = 0;
    for (let c = k + 1; c < n; c++) known += rows[k]![c]! * x[c]!;
    x[k] = (rows[k]![n]! - known) / rows[k]![k]!;
  }
  return x;
}

test("the curve is the solution of the dense system that the equation makes", async () => {
  const { styles, means, variances } = await modelFile();
  const [sides, states, parts, dims] = [2, STATES, 3, 63];
  const dof = 3 * JOINT.left_upper_leg;
  const neutral = styles.indexOf("neutral");
  const at = (side: number, state: number, part: number) => ((side * states + state) * parts + part) * dims + dof;
  const mean = (side: number, state: number, part: number) =>
    means[neutral * sides * states * parts * dims + at(side, state, part)]!;
  for (const change of [{}, { velocity: 1000, acceleration: 1000 }, { acceleration: 0.03 }, { pose: 0.01, left: 1 }]) {
    const state: ChainState = { ...PRESET, ...change };
    const path = await pathOf(engine, state);
    const factors = [state.pose, state.velocity, state.acceleration];
    // The whole walk: two steps, the displayed pair, and four more.
    const walk: [side: number, state: number][] = [];
    const begins: number[] = [];
    let sum = 0;
    for (let step = 0; step < 8; step++) {
      begins.push(walk.length);
      for (let one = 0; one < states; one++) {
        sum += path.durations[(step % 2) * states + one]!;
        const end = Math.max(Math.round(sum), walk.length + 1);
        while (walk.length < end) walk.push([step % 2, one]);
      }
    }
    const trajectory = (scale: readonly number[]) => {
      const a = walk.map(() => new Array<number>(walk.length).fill(0));
      const b = new Array<number>(walk.length).fill(0);
      walk.forEach(([side, one], t) => {
        const inside = t > 0 && t + 1 < walk.length;
        const rows: [number, number][][] = [
          [[t, 1]],
          [
            [t - 1, -0.5],
            [t + 1, 0.5],
          ],
          [
            [t - 1, 1],
            [t, -2],
            [t + 1, 1],
          ],
        ];
        rows.slice(0, inside ? 3 : 1).forEach((row, part) => {
          const weight = 1 / (scale[part]! * variances[at(side, one, part)]!);
          for (const [i, u] of row) {
            b[i]! += weight * u * mean(side, one, part);
            for (const [j, v] of row) a[i]![j]! += weight * u * v;
          }
        });
      });
      return solved(a, b).slice(begins[2], begins[4]);
    };
    const dense = trajectory(factors);
    expect(dense).toHaveLength(path.c.length);
    dense.forEach((c, i) => {
      expect(Math.abs(path.c[i]! - c) * DEGREES, `frame ${i}`).toBeLessThan(0.05);
    });
    // The measures of the exercises, from the dense curve.
    const farthestDense = Math.max(...dense.map((c, i) => Math.abs(c - mean(...walk[begins[2]! + i]!, 0)))) * DEGREES;
    expect(Math.abs(farthest(path) - farthestDense)).toBeLessThan(0.05);
    // Mutation: one variance off by a factor of ten gives another curve.
    const [pose, velocity, acceleration] = factors as [number, number, number];
    const other = trajectory([pose * 10, velocity, acceleration]);
    const off = Math.max(...other.map((c, i) => Math.abs(c - path.c[i]!))) * DEGREES;
    expect(off, "mutation").toBeGreaterThan(0.3);
  }
});

test("no nearby curve keeps the promises about poses better when they alone are firm", async () => {
  const [firm, plain] = await Promise.all([0.001, 1].map((pose) => pathOf(engine, { ...PRESET, pose })));
  const misfit = ({ c, mean }: JointPath, by = 0) => c.reduce((sum, value, i) => sum + (value + by - mean[i]!) ** 2, 0);
  expect(misfit(firm!)).toBeLessThan(0.2 * misfit(plain!));
  for (const by of [-0.05, 0.05]) expect(misfit(firm!)).toBeLessThan(misfit(firm!, by));
});

test("ρ makes each state longer by its variance", async () => {
  const [zero, one, two] = await Promise.all(
    [0, 1, 2].map((rho) => pathOf(engine, { ...PRESET, left: rho, right: rho })),
  );
  zero!.durations.forEach((frames, i) => {
    const variance = one!.durations[i]! - frames;
    expect(variance).toBeGreaterThan(0);
    expect(two!.durations[i]).toBeCloseTo(frames + 2 * variance, 3);
  });
});

test("the walk has the model's rate, and goes forwards", async () => {
  const { poses, rateHz } = await engine.walk({ neutral: 1 }, 90);
  expect(rateHz).toBe(WALK_HZ);
  expect(poses).toHaveLength(90 * POSE_FLOATS);
  expect(poses[89 * POSE_FLOATS + 2]! - poses[2]!).toBeGreaterThan(1.5);
});

test("A is passed by a firm promise about poses, or by loose ones about changes", async () => {
  expect((await result("A", {})).result).toBe("no");
  expect(await result("A", { pose: 0.001 })).toEqual({ result: "pass" });
  expect(await result("A", { velocity: 1000, acceleration: 1000 })).toEqual({ result: "pass" });
  expect(await result("A", { pose: 0.003 })).toEqual({ result: "near", way: "further" });
  expect(await result("A", { pose: 10 })).toEqual({ result: "refuse" });
  expect(await result("A", { acceleration: 0.1 })).toEqual({ result: "refuse" });
  for (const other of [{ share: 1 }, { joint: "right_upper_leg" }, { axis: "y" }] as const)
    expect(await result("A", { pose: 0.001, ...other })).toEqual({ result: "near", way: "other" });
  // One kind of change alone is not enough, nor are other durations.
  for (const one of [{ velocity: 1000 }, { acceleration: 1000 }, { left: 3, right: 3 }, { left: -2, right: -2 }])
    expect((await result("A", one)).result).toBe("no");
  const [en, de] = [await TEXTS.en.lessons.chain!(), await TEXTS.de.lessons.chain!()];
  expect(en.exercises.A!.refuse(await said("en", "A", { acceleration: 0.1 }))).toMatch(
    /^The promise about the angle is now the weaker one: the curve is 7\.8° from a mean\./,
  );
  expect(de.exercises.A!.refuse(await said("de", "A", { acceleration: 0.1 }))).toMatch(
    /^Die Zusage über den Winkel ist jetzt die schwächere: Die Kurve ist 7,8° von einem Mittel entfernt\./,
  );
});

test("B is passed by a stretch of σ″², and refuses one that is too firm", async () => {
  const passing: number[] = [];
  for (let thousandths = 10; thousandths <= 150; thousandths++)
    if ((await result("B", { acceleration: thousandths / 1000 })).result === "pass") passing.push(thousandths);
  expect(passing.length).toBe(passing.at(-1)! - passing[0]! + 1);
  // As the hint says: between a thirtieth and a tenth.
  expect(passing[0]).toBeGreaterThan(1000 / 30);
  expect(passing.at(-1)).toBeLessThan(100);
  expect(await result("B", { acceleration: 0.1 })).toEqual({ result: "near", way: "rough" });
  expect(await result("B", { acceleration: 0.03 })).toEqual({ result: "near", way: "far" });
  expect(await result("B", { acceleration: 0.01 })).toEqual({ result: "refuse" });
  for (const other of [{ pose: 0.1 }, { pose: 1000 }, { velocity: 0.1 }])
    expect(await result("B", other)).toEqual({ result: "no" });
  for (const other of [{ joint: "right_toes" }, { axis: "z" }, { share: 0.5 }] as const)
    expect(await result("B", { acceleration: 0.08, ...other })).toEqual({ result: "near", way: "other" });
  const [en, de] = [await TEXTS.en.lessons.chain!(), await TEXTS.de.lessons.chain!()];
  expect(en.exercises.B!.refuse(await said("en", "B", { acceleration: 0.01 }))).toMatch(
    /^0\.40 times the jerk, but 3\.23 σ from a mean: a promise that is too firm breaks the others\.$/,
  );
  expect(de.exercises.B!.refuse(await said("de", "B", { acceleration: 0.01 }))).toMatch(/^Das 0,40-Fache des Rucks/);
});

test("C is passed by longer states, and refuses a negative ρ", async () => {
  expect((await result("C", {})).result).toBe("no");
  expect(await result("C", { left: 1.1, right: 0.95 })).toEqual({ result: "pass" });
  // As in the hint.
  expect(await result("C", { left: 1, right: 1 })).toEqual({ result: "pass" });
  expect(await result("C", { left: 0.8, right: 0.8 })).toEqual({ result: "near", way: "longer" });
  expect(await result("C", { left: 1.3, right: 1.2 })).toEqual({ result: "near", way: "shorter" });
  expect(await result("C", { left: 1, right: 1, share: 0.5 })).toEqual({ result: "near", way: "other" });
  expect(await result("C", { left: -1, right: -1 })).toEqual({ result: "refuse" });
  const [en, de] = [await TEXTS.en.lessons.chain!(), await TEXTS.de.lessons.chain!()];
  expect(en.exercises.C!.refuse(await said("en", "C", { left: -1, right: -1 }))).toMatch(
    /^A negative ρ makes states shorter: 127\.1 steps a minute\./,
  );
  expect(de.exercises.C!.refuse(await said("de", "C", { left: -1, right: -1 }))).toMatch(/: 127,1 Schritte/);
  // By hand: twice a minute's frames divided by those of both steps; mutation: divided by those of one side.
  const { durations } = await pathOf(engine, PRESET);
  const frames = (from: number) => durations.slice(from, from + STATES).reduce((sum, d) => sum + d, 0);
  const { cadence } = await measureChain(engine, PRESET);
  expect(cadence).toBeCloseTo(3600 / (frames(0) + frames(STATES)), 6);
  expect(cadence, "mutation").not.toBeCloseTo(1800 / frames(0), 1);
});
