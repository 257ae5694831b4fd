import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { KeyStyleClips } from "../engine/build/key_style_training";
import { loadBuiltIn } from "../engine/built_in";
import { KeyStyleModel } from "../engine/key_style/model";
import { serveLearnPackage } from "../engine/learn/wasm";
import { draggedOf, errorsOf, keyedOf, measureMap, passOf, samplesOf, worstStretch } from "../figures/map/map_measure";
import { BLUR, MAP_FIELDS, type MapState, sharingOf } from "../figures/map/map_state";
import { DEGREES, POSE_FLOATS } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { map } from "./map";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(MAP_FIELDS);
const exercise = (id: string) => map.exercises.find((one) => one.id === id)!;
const said = async (language: "en" | "de", patch: Partial<MapState>) =>
  saidIn(language, await measureMap(engine, { ...PRESET, ...patch }), map.decimals);
const result = async (id: string, patch: Partial<MapState>) =>
  judge(exercise(id), await measureMap(engine, { ...readHash(MAP_FIELDS, exercise(id).start("")), ...patch }));
const frames = async () => (await samplesOf(engine)).values.length / 2;
const mean = (values: Float32Array) => values.reduce((sum, value) => sum + value, 0) / values.length;

test("the bet: as printed, learning diverges", async () => {
  const { answer, measure } = await map.bet.reveal(engine);
  expect(answer).toBe("diverges");
  expect(Number(measure.right)).toBeLessThan(0.1 * DEGREES);
  expect(Number(measure.printed)).toBeGreaterThan(DEGREES);
  const [en, de] = [await TEXTS.en.lessons.map!(), await TEXTS.de.lessons.map!()];
  expect(en.bet.reveal(saidIn("en", measure, map.decimals))).toMatch(/^After 400 updates the error is \d\.\d° with/);
  expect(de.bet.reveal(saidIn("de", measure, map.decimals))).toMatch(/^Nach 400 Schritten ist der Fehler \d,\d° mit/);
});

test("an update shares the sample, and moves shares and centres as the equations say", async () => {
  const [before, after] = [await engine.somn(40, false), await engine.somn(41, false)];
  expect(after.updates).toBe(41);
  expect(after.r.reduce((sum, r) => sum + r, 0)).toBeCloseTo(1, 5);
  const { values } = await samplesOf(engine);
  after.r.forEach((r, i) => {
    expect(after.weights[i]).toBeCloseTo(before.weights[i]! + 0.2 * after.delta * (r - before.weights[i]!), 4);
    for (const axis of [0, 1]) {
      const [m, next] = [before.centres[2 * i + axis]!, after.centres[2 * i + axis]!];
      const u = values[2 * after.sample + axis]!;
      expect(Math.abs(next - (m + after.delta * r * (u - m)))).toBeLessThan(0.01 * Math.abs(u - m) + 1e-3);
    }
  });
});

test("learning goes on from where it is, or begins again, with the same result", async () => {
  const direct = await engine.somn(150, false);
  await engine.somn(20, false);
  const again = await engine.somn(150, false);
  expect(again.centres).toEqual(direct.centres);
  expect((await engine.somn(20, false)).sigma).toBeGreaterThan(direct.sigma);
});

test("the width narrows and the rate falls from pass to pass", async () => {
  const n = await frames();
  const [first, last] = [await engine.somn(n, false), await engine.somn(20 * n, false)];
  expect(first.sigma / last.sigma).toBeGreaterThan(4);
  expect(first.delta / last.delta).toBeGreaterThan(20);
  expect(passOf(n - 1, n)).toBe(0);
  expect(passOf(20 * n, n)).toBe(20);
});

test("the greatest change is that of poses that are asked for one by one", async () => {
  const { values } = await samplesOf(engine);
  const sharing = sharingOf({ temperature: 2 });
  expect(sharing.blur).toBe(BLUR);
  // The first leg of the first drag, from the same fixed sequence.
  let seed = 1;
  const next = () => {
    seed = (seed * 1_103_515_245 + 12_345) % 2_147_483_648;
    const frame = Math.floor((seed / 2_147_483_648) * (values.length / 2));
    return [values[2 * frame]!, values[2 * frame + 1]!] as const;
  };
  const [from, to] = [next(), next()];
  let greatest = 0;
  let before: Float32Array | undefined;
  for (let i = 0; i < 45; i++) {
    const at = [0, 1].map((axis) => from[axis]! + (i / 45) * (to[axis]! - from[axis]!));
    const { pose } = await engine.stylePose(at, sharing);
    if (before)
      for (let joint = 3; joint < POSE_FLOATS; joint += 4) {
        let cosine = 0;
        for (let k = joint; k < joint + 4; k++) cosine += pose[k]! * before[k]!;
        greatest = Math.max(greatest, (360 / Math.PI) * Math.acos(Math.min(1, Math.abs(cosine))));
      }
    before = pose;
  }
  const { change } = await draggedOf(engine, 2);
  expect(greatest).toBeGreaterThan(0.5);
  expect(change).toBeGreaterThanOrEqual(greatest);
});

/** The model of the lesson, trained again. */
async function learned(): Promise<KeyStyleModel> {
  const clips = await KeyStyleClips.ofDatabase(await loadBuiltIn());
  const axes = ["foot_separation", "foot_height_difference"];
  const { file } = clips.train({ clips: [], action: "walk", axes, components: 0, em: false }, () => {});
  clips.dispose();
  return KeyStyleModel.open(file);
}

/** Mean angle between the joints of two poses, by plain loops over their quaternions, degrees. */
function apart(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let [sum, joints] = [0, 0];
  for (let i = 3; i < POSE_FLOATS; i += 4) {
    const dot = a[i]! * b[i]! + a[i + 1]! * b[i + 1]! + a[i + 2]! * b[i + 2]! + a[i + 3]! * b[i + 3]!;
    sum += 2 * Math.acos(Math.min(1, Math.abs(dot)));
    joints++;
  }
  return (sum / joints) * DEGREES;
}

const variables = (model: KeyStyleModel, frame: number) => Array.from(model.values.subarray(2 * frame, 2 * frame + 2));

test("the errors of exercises are mean angles, by plain loops over all poses", async () => {
  const model = await learned();
  const count = model.values.length / 2;
  const poser = model.poser();
  const errorIn = (mode: Parameters<KeyStyleModel["error"]>[0], later = 0) => {
    poser.mode = mode;
    let sum = 0;
    for (let frame = 0; frame < count; frame++)
      sum += apart(poser.jump(variables(model, frame)).pose, model.recorded((frame + later) % count)!);
    return sum / count;
  };
  const [{ shared }, last] = [
    await measureMap(engine, { ...PRESET, temperature: 4 }),
    (await errorsOf(engine)).at(-1)!,
  ];
  expect(errorIn(sharingOf({ temperature: 4 }))).toBeCloseTo(Number(shared), 2);
  expect(errorIn("hard")).toBeCloseTo(last, 2);
  // Mutations: another T, other frames.
  expect(errorIn(sharingOf({ temperature: 2 })), "mutation").not.toBeCloseTo(Number(shared), 1);
  expect(errorIn("hard", 5) - last, "mutation").toBeGreaterThan(1);
  // A cycle from keys: poses from its variables.
  const { cycle } = await samplesOf(engine);
  const keyed = await keyedOf(engine, [2, 12, 23]);
  poser.mode = { temperature: 2, blur: 0 };
  const errors = Array.from(keyed.errors, (_, i) =>
    apart(poser.jump([keyed.values[2 * i]!, keyed.values[2 * i + 1]!]).pose, model.recorded(cycle.first + i)!),
  );
  const off = (of: number[]) => Math.max(...of.map((error, i) => Math.abs(error - keyed.errors[i]!)));
  expect(off(errors)).toBeLessThan(0.1);
  expect(off([...errors.slice(4), ...errors.slice(0, 4)]), "mutation: other frames").toBeGreaterThan(0.5);
  poser.dispose();
  model.dispose();
});

test("an update moves a prediction by δ r of the way to the sample", async () => {
  const model = await learned();
  // A run that is ahead gives the next sample.
  const [run, ahead] = [model.learn(), model.learn()];
  for (const one of [run, ahead]) one.step(2 * run.frames);
  const errorOf = (frame: number) => {
    const soFar = run.model();
    const poser = soFar.poser();
    poser.mode = "hard";
    const error = apart(poser.jump(variables(model, frame)).pose, model.recorded(frame)!);
    poser.dispose();
    soFar.dispose();
    return error;
  };
  const [right, half]: number[][] = [[], []];
  for (let i = 0; i < 60; i++) {
    const { sample } = ahead.step(1);
    const before = errorOf(sample);
    const { delta, r } = run.step(1);
    const most = r.reduce((a, b) => Math.max(a, b), 0);
    // If one component takes nearly all, it is usually also the likeliest by the variables.
    if (most < 0.95) continue;
    const left = errorOf(sample) / before;
    right!.push(Math.abs(left - (1 - delta * most)));
    half!.push(Math.abs(left - (1 - 0.5 * delta * most)));
  }
  const median = (values: number[]) => values.sort((a, b) => a - b)[values.length >> 1]!;
  expect(right!.length).toBeGreaterThan(12);
  expect(median(right!)).toBeLessThan(0.02);
  expect(median(half!), "mutation: half of δ").toBeGreaterThan(0.15);
  for (const one of [run, ahead, model]) one.dispose();
});

test("the ghost is the prediction for the last sample; before the first update there is none", async () => {
  expect(await engine.somnPoses(0, false)).toBeUndefined();
  const n = await frames();
  const [early, late] = [(await engine.somnPoses(40, false))!, (await engine.somnPoses(10 * n, false))!];
  expect(early.apart).toBeCloseTo(apart(early.sample, early.predicted), 3);
  expect(late.apart).toBeLessThan(5);
  const model = await learned();
  const { sample } = await engine.somn(40, false);
  expect(apart(early.sample, model.recorded(sample)!)).toBeLessThan(0.1);
  expect(apart(early.sample, model.recorded((sample + 8) % n)!), "mutation").toBeGreaterThan(0.5);
  model.dispose();
  const printed = (await engine.somnPoses(400, true))!;
  expect(printed.apart > 20 || Number.isNaN(printed.apart)).toBe(true);
});

test("keys are where the variables are recorded, and the worst stretch is between two of them", async () => {
  const { values, cycle } = await samplesOf(engine);
  const keys = [2, 12, 23];
  const keyed = await keyedOf(engine, keys);
  for (const key of keys)
    for (const axis of [0, 1])
      expect(keyed.values[2 * key + axis]).toBeCloseTo(values[2 * (cycle.first + key) + axis]!, 2);
  expect(worstStretch(Float32Array.of(1, 0, 0, 5, 0, 0), [2, 4])).toEqual({ from: 2, to: 4, error: 5 });
  expect(worstStretch(Float32Array.of(6, 0, 0, 5, 0, 0), [2, 4])).toEqual({ from: 4, to: 2, error: 6 });
});

test("A is passed by one pass alone", async () => {
  const n = await frames();
  const errors = await errorsOf(engine);
  const passing: number[] = [];
  for (let pass = 0; pass <= errors.length; pass++)
    if ((await result("A", { updates: pass * n })).result === "pass") passing.push(pass);
  expect(passing).toHaveLength(1);
  const [first] = passing as [number];
  expect(errors[first - 1]! / errors.at(-1)!).toBeLessThan(1.05);
  expect(errors[first - 2]! / errors.at(-1)!).toBeGreaterThan(1.05);
  expect(await result("A", { updates: (first - 1) * n })).toEqual({ result: "near", way: "later" });
  expect(await result("A", { updates: (first + 3) * n })).toEqual({ result: "near", way: "earlier" });
  expect(await result("A", { updates: errors.length * n })).toEqual({ result: "refuse" });
  expect((await result("A", {})).result).toBe("no");
  const [en, de] = [await TEXTS.en.lessons.map!(), await TEXTS.de.lessons.map!()];
  const end = { updates: errors.length * n };
  expect(en.exercises.A!.refuse(await said("en", end))).toMatch(/^After 20 passes it is 1\.3\d°\. That is the end;/);
  expect(de.exercises.A!.refuse(await said("de", end))).toMatch(/^Nach 20 Durchgängen sind es 1,3\d°\./);
});

test("B is passed by a stretch of T, and refuses a hard change", async () => {
  const passing: number[] = [];
  for (const temperature of [1, 2, 3, 3.5, 4, 4.5, 5, 5.5, 6, 8])
    if ((await result("B", { temperature })).result === "pass") passing.push(temperature);
  expect(passing).toEqual([4, 4.5]);
  expect(await result("B", {})).toEqual({ result: "refuse" });
  expect(await result("B", { temperature: 3.5 })).toEqual({ result: "near", way: "softer" });
  expect(await result("B", { temperature: 6 })).toEqual({ result: "near", way: "harder" });
  expect(await result("B", { temperature: 16 })).toEqual({ result: "no" });
  const ends: number[] = [];
  for (let tenths = 30; tenths <= 60; tenths++)
    if ((await result("B", { temperature: tenths / 10 })).result === "pass") ends.push(tenths);
  expect([ends[0], ends.at(-1), ends.length]).toEqual([40, 48, 9]);
  const [en, de] = [await TEXTS.en.lessons.map!(), await TEXTS.de.lessons.map!()];
  expect(en.exercises.B!.refuse(await said("en", {}))).toMatch(
    /^Weights that switch abruptly make the body jump: 15\.7° a frame\./,
  );
  expect(de.exercises.B!.refuse(await said("de", {}))).toMatch(/den Körper springen: 15,7° je Bild\./);
});

test("C wants three keys in the right places, and says where it is worst", async () => {
  expect(await result("C", {})).toEqual({ result: "refuse" });
  const { cycle } = await samplesOf(engine);
  const even = (first: number, count: number) =>
    Array.from({ length: count }, (_, i) => Math.round(first + (i * cycle.frames) / count));
  const found: Record<string, number> = {};
  for (let first = 0; first < 10; first++) {
    const { result: how } = await result("C", { keys: even(first, 3) });
    found[how] = (found[how] ?? 0) + 1;
    const error = mean((await keyedOf(engine, even(first, 3))).errors);
    expect(how === "pass").toBe(error <= 2);
  }
  expect(found.pass).toBeGreaterThan(1);
  expect(found.near).toBeGreaterThan(1);
  expect(await result("C", { keys: even(0, 4) })).toEqual({ result: "near", way: "fewer" });
  // Two keys are never enough.
  for (let first = 0; first < cycle.frames; first += 3)
    for (let second = first + 1; second < cycle.frames; second += 3)
      expect((await result("C", { keys: [first, second] })).result).toBe("refuse");
  const [en, de] = [await TEXTS.en.lessons.map!(), await TEXTS.de.lessons.map!()];
  expect(en.exercises.C!.refuse(await said("en", {}))).toMatch(
    /^2 keys are too few: from key \d+ ms to \d+ ms it is off by up to \d+\.\d\d°\.$/,
  );
  expect(de.exercises.C!.refuse(await said("de", {}))).toMatch(/^2 Schlüsselbilder sind zu wenige: Vom Schlüsselbild/);
});
