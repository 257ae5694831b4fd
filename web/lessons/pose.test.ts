import { beforeAll, expect, test } from "vitest";
import { saidIn } from "../app/views/learn/said";
import { createLearnTable } from "../client/learn/learn_table";
import { serveLearnPackage } from "../engine/learn/wasm";
import { LANGUAGES, WORDS } from "../figures/languages";
import {
  changedNumbers,
  DOFS,
  degreesOfFreedom,
  greatestJump,
  measurePose,
  motionOf,
  numbersAt,
  rawLog,
  rotationAt,
} from "../figures/pose/pose_measure";
import { POSE_FIELDS, type PoseState } from "../figures/pose/pose_state";
import { turnOf, withTurn } from "../figures/turned_joints";
import {
  DEGREES,
  exp,
  JOINT,
  JOINTS,
  multiply,
  POSE_FLOATS,
  type Quaternion,
  quaternionAt,
  type Vector,
} from "../humanoid";
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

/** w by another method: the angle from the real part, the axis from the rest. */
function plainLog([x, y, z, w]: Quaternion): Vector {
  const sign = w < 0 ? -1 : 1;
  const length = Math.hypot(x, y, z);
  const angle = 2 * Math.atan2(length, Math.abs(w));
  return [x, y, z].map((value) => (sign * value * angle) / Math.max(1e-12, length)) as unknown as Vector;
}

/** The product of two quaternions, written out. */
function product([ax, ay, az, aw]: Quaternion, [bx, by, bz, bw]: Quaternion): Quaternion {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

test("jumps of log R are those of a plain loop", async () => {
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  const jumpAt = (phi: number) => {
    const half = phi / DEGREES / 2;
    let greatest = 0;
    let before: Vector | undefined;
    for (let i = 0; i < 882; i++) {
      const now = plainLog(product(rotationAt(motion, "left_upper_leg", i), [Math.sin(half), 0, 0, Math.cos(half)]));
      if (before) greatest = Math.max(greatest, Math.hypot(...now.map((value, k) => value - before![k]!)));
      before = now;
    }
    return greatest;
  };
  for (const phi of [0, 170]) {
    const { rawJump } = await measurePose(engine, { ...PRESET, joint: "left_upper_leg", phi });
    expect(rawJump).toBeCloseTo(jumpAt(phi), 2);
    expect(Math.abs(Number(rawJump) - jumpAt(170 - phi)), "mutation: other axes").toBeGreaterThan(5);
  }
});

test("the angle from the mean is that between two rotations", async () => {
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  const mean = quaternionAt(motion.means, JOINT.left_lower_leg);
  const { angle, bend, aside, straight } = await measurePose(engine, PRESET);
  expect(angle).toBeCloseTo(between(mean, rotationAt(motion, "left_lower_leg", PRESET.at)), 1);
  expect(Math.hypot(Number(bend), Number(aside))).toBeCloseTo(Number(angle), 6);
  expect(straight).toBeCloseTo(between([0, 0, 0, 1], rotationAt(motion, "left_lower_leg", PRESET.at)), 1);
  const later = between(mean, rotationAt(motion, "left_lower_leg", PRESET.at + 20));
  expect(Math.abs(Number(angle) - later), "mutation: another frame").toBeGreaterThan(3);
  const other = between(
    quaternionAt(motion.means, JOINT.left_upper_leg),
    rotationAt(motion, "left_lower_leg", PRESET.at),
  );
  expect(Math.abs(Number(angle) - other), "mutation: another joint's mean").toBeGreaterThan(3);
});

test("the text counts as the engine does", async () => {
  for (const language of LANGUAGES) {
    const text = await TEXTS[language].lessons.pose!();
    expect(text.bet.question).toContain(String(DOFS));
    expect(WORDS[language].pose.numbers).toContain(String(DOFS));
    expect(text.idea.join(" ")).toContain(`${JOINTS}\u00a0·\u00a03\u00a0=\u00a0${3 * JOINTS}`);
  }
});

test("A is passed from φ 168° on, and no other φ", async () => {
  for (let phi = 0; phi <= 180; phi += phi < 160 ? 10 : 1) {
    const wanted =
      phi >= 168 ? { result: "pass" } : phi >= 150 ? { result: "near", way: "further" } : { result: "refuse" };
    expect(await result("A", { phi }), `φ ${phi}°`).toEqual(wanted);
  }
  const { exercises } = await TEXTS.en.lessons.pose!();
  const german = await TEXTS.de.lessons.pose!();
  const measure = await measurePose(engine, { ...PRESET, joint: "left_upper_leg", phi: 90 });
  expect(exercises.A!.refuse(saidIn("en", measure))).toBe("Both are smooth at φ 90°: turn further.");
  expect(german.exercises.A!.refuse(saidIn("de", measure))).toBe("Beide sind glatt bei φ 90°: Dreh weiter.");
});

test("A is passed where the swing reaches 180°", async () => {
  const { joint } = readHash(POSE_FIELDS, exercise("A").start(""));
  expect(await result("A", { phi: 90 })).toEqual({ result: "refuse" });
  expect(await result("A", { phi: 160 })).toEqual({ result: "near", way: "further" });
  expect(await result("A", { phi: 170 })).toEqual({ result: "pass" });
  expect(await result("A", { phi: 180 })).toEqual({ result: "pass" });
  for (const state of [{ joint: "left_lower_leg" }, { heading: 90 }, { motion: "neutral run" }] as const)
    expect(await result("A", { phi: 170, ...state })).toEqual({ result: "near", way: "other" });
  const motion = await motionOf(engine, PRESET.motion, [], 0);
  // By hand: somewhere the angle of the rotated thigh exceeds 180°, and its vector is reversed.
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
  for (const degrees of [-10, -3.2, -2.8, -1, 1, 2.8, 3.2, 10])
    expect((await result("B", { turned: more(degrees) })).result === "pass", `${degrees}°`).toBe(Math.abs(degrees) < 3);
  const aside = withTurn([], "left_lower_leg", [by[0], by[1] + 4 / DEGREES, by[2]]);
  expect(await result("B", { turned: aside })).toEqual({ result: "near", way: "aside" });
  for (const state of [{ at: 100 }, { joint: "left_upper_leg" }, { motion: "neutral run" }] as const)
    expect(await result("B", { turned, ...state })).toEqual({ result: "near", way: "other" });
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
  const german = await TEXTS.de.lessons.pose!();
  expect(german.exercises.B!.refuse(saidIn("de", await measurePose(engine, { ...PRESET, turned: straight })))).toMatch(
    /^Das ist ein gestrecktes Bein, 3\d,\d\d° vom Mittel/,
  );
});
