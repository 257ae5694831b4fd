/**
 * An animation of the canonical humanoid as BVH text: 21 joints whose zero pose is the T-pose, centimetres, with the
 * same joints, channels and end sites as in `rust/strut-formats/src/bvh/humanoid.rs`, which is not in the package of
 * characters.
 */
import { JOINT, JOINTS, PARENTS, POSE_FLOATS, ROLES, type Role } from "../humanoid";

/** Poses at a constant frame rate. */
interface EvenAnimation {
  /** Bone offsets in the T-pose, 21 × xyz, metres; the hips' entry is not used. */
  readonly proportions: ArrayLike<number>;
  /** `POSE_FLOATS` numbers per frame. */
  readonly poses: ArrayLike<number>;
  readonly rateHz: number;
}

/** Ends of the bones without a child joint, metres. */
const ENDS: Readonly<Partial<Record<Role, readonly number[]>>> = {
  head: [0, 0.18, 0],
  left_hand: [0.16, 0, 0],
  right_hand: [-0.16, 0, 0],
  left_toes: [0, 0, 0.07],
  right_toes: [0, 0, 0.07],
};

const nameOf = (role: Role): string => role.replace(/(?:^|_)(.)/g, (_, letter: string) => letter.toUpperCase());

/** Six decimals, without negative zero. */
const number = (value: number): string => String(Math.round(value * 1e6) / 1e6 + 0);

const centimetres = (xyz: readonly number[]): string => xyz.map((value) => number(100 * value)).join(" ");

/** Writes the text. */
export function bvhText({ proportions, poses, rateHz }: EvenAnimation): string {
  const frames = Math.floor(poses.length / POSE_FLOATS);
  const lines = ["HIERARCHY", ...jointLines(JOINT.hips, proportions, 0)];
  lines.push("MOTION", `Frames: ${frames}`, `Frame Time: ${1 / rateHz}`);
  for (let frame = 0; frame < frames; frame++) {
    const at = frame * POSE_FLOATS;
    const row = [centimetres([poses[at]!, poses[at + 1]!, poses[at + 2]!])];
    for (let joint = 0; joint < JOINTS; joint++)
      row.push(
        anglesAt(poses, at + 3 + 4 * joint)
          .map(number)
          .join(" "),
      );
    lines.push(row.join(" "));
  }
  return `${lines.join("\n")}\n`;
}

/** A joint and its descendants. */
function jointLines(joint: number, proportions: ArrayLike<number>, depth: number): string[] {
  const role = ROLES[joint]!;
  const [indent, inside] = ["\t".repeat(depth), "\t".repeat(depth + 1)];
  const isRoot = PARENTS[joint]! < 0;
  // The channels of the hips replace their offset.
  const offset = isRoot ? [0, 0, 0] : [0, 1, 2].map((axis) => proportions[3 * joint + axis]!);
  const rotations = "Zrotation Xrotation Yrotation";
  const end = ENDS[role];
  return [
    `${indent}${isRoot ? "ROOT" : "JOINT"} ${nameOf(role)}`,
    `${indent}{`,
    `${inside}OFFSET ${centimetres(offset)}`,
    `${inside}CHANNELS ${isRoot ? `6 Xposition Yposition Zposition ${rotations}` : `3 ${rotations}`}`,
    ...PARENTS.flatMap((parent, child) => (parent === joint ? jointLines(child, proportions, depth + 1) : [])),
    ...(end ? [`${inside}End Site`, `${inside}{`, `${inside}\tOFFSET ${centimetres(end)}`, `${inside}}`] : []),
    `${indent}}`,
  ];
}

/** A quaternion, xyzw, as the degrees of rotations about Z, then the rotated X, then the rotated Y. */
function anglesAt(values: ArrayLike<number>, at: number): [number, number, number] {
  const length = Math.hypot(values[at]!, values[at + 1]!, values[at + 2]!, values[at + 3]!) || 1;
  const [x, y, z, w] = [0, 1, 2, 3].map((k) => values[at + k]! / length) as [number, number, number, number];
  const sine = 2 * (y * z + x * w);
  const flat = Math.hypot(2 * (x * y - z * w), 1 - 2 * (x * x + z * z));
  // If the second rotation is a right angle, the first and the third have the same axis (gimbal lock): the third is set
  // to 0.
  const isLocked = flat < 1e-6;
  const turnZ = isLocked
    ? Math.atan2(2 * (x * y + z * w), 1 - 2 * (y * y + z * z))
    : Math.atan2(2 * (z * w - x * y), 1 - 2 * (x * x + z * z));
  const turnY = isLocked ? 0 : Math.atan2(2 * (y * w - x * z), 1 - 2 * (x * x + y * y));
  return [turnZ, Math.atan2(sine, flat), turnY].map((angle) => (angle * 180) / Math.PI) as [number, number, number];
}
