import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import {
  changedNumbers,
  degreesOfFreedom,
  greatestJump,
  measurePose,
  motionOf,
  numbersAt,
  rawLog,
  rotationAt,
} from "../element/figure/pose/pose_measure";
import { POSE_FIELDS, type PoseState } from "../element/figure/pose/pose_state";
import { turnOf, withTurn } from "../element/figure/turned_joints";
import { serveLearnPackage } from "../engine/learn/wasm";
import { DEGREES, exp, JOINT, multiply, POSE_FLOATS, type Quaternion, quaternionAt, type Vector } from "../humanoid";
import { initialOf, readHash } from "../link/hash";
import { judge } from "./lesson";
import { pose } from "./pose";
import { TEXTS } from "./text";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

const PRESET = initialOf(POSE_FIELDS);
const exercise = (id: string) => pose.exercises.find((one) => one.id === id)!;
const result = async (id: string, patch: Partial<PoseState>) =>
  judge(exercise(id), await measurePose(engine, { ...readHash(POSE_FIELDS, exercise(id).start("")), ...patch }));
/** The angle between two rotations, degrees. */
const between = (a: Quaternion, b: Quaternion) =>
  2 * DEGREES * Math.acos(Math.min(1, Math.abs(a.reduce((sum, value, i) => sum + value * b[i]!, 0))));

test("the bet: a turned walker has the same numbers, though not the same path", async () => {
  const { answer, measure } = await pose.bet.reveal(engine);
  expect(answer).toBe("none");
  expect(measure.changed).toBe("0");
  const [plain, turned] = await Promise.all([0, 90].map((heading) => motionOf(engine, PRESET.motion, [], heading)));
  const at = (PRESET.at + 1) * POSE_FLOATS;
  const gone = ({ poses }: typeof plain & object, axis: number) => poses[at + axis]! - poses[axis]!;
  // A quarter turn about +Y takes +Z to +X.
  expect(gone(turned!, 0)).toBeCloseTo(gone(plain!, 2), 3);
  expect(gone(turned!, 2)).toBeCloseTo(-gone(plain!, 0), 3);
  expect(gone(plain!, 2)).toBeGreaterThan(2);
});

test("a bent limb changes the numbers of its joint alone", async () => {
  const turned = withTurn([], "left_lower_leg", [0.2, 0.1, -0.3]);
  expect(await changedNumbers(engine, { ...PRESET, turned })).toBe(3);
});

test("the mean rotation and exp w are the rotation of the joint", async () => {
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  for (const joint of ["left_lower_leg", "right_upper_arm"] as const) {
    const w = degreesOfFreedom(motion, joint, 0, PRESET.at);
    const mean = quaternionAt(motion.means, JOINT[joint]);
    expect(between(multiply(mean, exp(w)), rotationAt(motion, joint, PRESET.at))).toBeLessThan(0.05);
  }
});

test("own axes turn w, and change log R", async () => {
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  const [plain, turned] = [0, 90].map((phi) => degreesOfFreedom(motion, "left_upper_leg", phi, 160)) as [
    Vector,
    Vector,
  ];
  expect(Math.hypot(...turned)).toBeCloseTo(Math.hypot(...plain), 6);
  expect(turned[0]).toBeCloseTo(plain[0], 6);
  expect(turned[1]).toBeCloseTo(plain[2], 6);
  expect(
    between(exp(rawLog(motion, "left_upper_leg", 90, 160)), rotationAt(motion, "left_upper_leg", 160)),
  ).toBeCloseTo(90, 1);
});

test("a jump is the greatest step of a vector", () => {
  const vectors: Vector[] = [
    [0, 0, 0],
    [0, 0.3, 0.4],
    [0, 0.3, 0.2],
  ];
  expect(greatestJump(3, (i) => vectors[i]!)).toBeCloseTo(0.5, 12);
});

test("numbers are 67, and say how high the hips are", async () => {
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  const numbers = numbersAt(motion, PRESET.at);
  expect(numbers).toHaveLength(67);
  expect(numbers[63]).toBeCloseTo(motion.poses[PRESET.at * POSE_FLOATS + 1]!, 4);
});

test("A is passed where the swing reaches 180°", async () => {
  const { joint } = readHash(POSE_FIELDS, exercise("A").start(""));
  expect(await result("A", { phi: 90 })).toEqual({ result: "refuse" });
  expect(await result("A", { phi: 160 })).toEqual({ result: "near", way: "further" });
  expect(await result("A", { phi: 170 })).toEqual({ result: "pass" });
  expect(await result("A", { phi: 180 })).toEqual({ result: "pass" });
  expect(await result("A", { phi: 170, joint: "left_lower_leg" })).toEqual({ result: "near", way: "other" });
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  // By hand: somewhere the angle of the turned thigh passes 180°, and its vector turns round.
  const angles = Array.from({ length: 880 }, (_, i) => rotationAt(motion, joint, i)).map(
    ([x, , , w]) => 2 * Math.atan2(x, w) * DEGREES,
  );
  expect(Math.max(...angles) + 170).toBeGreaterThan(180);
  expect(Math.max(...angles) + 160).toBeLessThan(180);
});

test("B refuses a straight leg, and says so", async () => {
  expect((await result("B", {})).result).toBe("no");
  const { turned } = readHash(POSE_FIELDS, await exercise("B").solve(engine));
  const by = turnOf(turned, "left_lower_leg");
  const more = (degrees: number) => withTurn([], "left_lower_leg", [by[0] + degrees / DEGREES, by[1], by[2]]);
  expect(await result("B", { turned: more(0) })).toEqual({ result: "pass" });
  expect(await result("B", { turned: more(5) })).toEqual({ result: "near", way: "stretch" });
  expect(await result("B", { turned: more(-5) })).toEqual({ result: "near", way: "bend" });
  expect(await result("B", { turned, at: 100 })).toEqual({ result: "near", way: "other" });
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  const [x, y, z, w] = rotationAt(motion, "left_lower_leg", PRESET.at);
  const straight = withTurn(
    [],
    "left_lower_leg",
    [x, y, z].map((value) => -2 * value * (Math.acos(w) / Math.hypot(x, y, z))) as unknown as Vector,
  );
  expect(await result("B", { turned: straight })).toEqual({ result: "refuse" });
  const text = await TEXTS.en.lessons.pose!();
  expect(text.exercises.B!.refuse(saidIn("en", await measurePose(engine, { ...PRESET, turned: straight })))).toMatch(
    /^That is a straight leg, 3\d\.\d\d° from the mean/,
  );
});
