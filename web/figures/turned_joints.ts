/** Joints that are rotated by hand: their part of a figure's state. */
import type { Turn } from "../client/learn/protocol";
import { DEGREES, JOINT, ROLES, type Role, type Vector } from "../humanoid";
import { type Field, listed } from "../link/fields";

/** A joint rotated relative to the input. */
export interface TurnedJoint {
  joint: Role;
  /** An axis times an angle about the axes of the joint's parent, degrees. */
  by: Vector;
}

/** Decimals of an angle in a link. */
const DIGITS = 1;

/** Encoding of rotated joints in a link: `joint:x:y:z,…`. */
export function turnedJoints(key: string): Field<readonly TurnedJoint[]> {
  return listed(key, [], encode, decode);
}

function encode(turned: readonly TurnedJoint[]): string {
  return turned
    .map(({ joint, by }) => [joint, ...by.map((angle) => Number(angle.toFixed(DIGITS)))].join(":"))
    .join(",");
}

/** Decodes {@link encode}; `undefined` if a joint is unknown or listed twice, or an angle is not below 180°. */
function decode(text: string): readonly TurnedJoint[] | undefined {
  const turned: TurnedJoint[] = [];
  for (const part of text === "" ? [] : text.split(",", ROLES.length + 1)) {
    const [name, ...numbers] = part.split(":");
    const joint = ROLES.find((role) => role === name);
    const by = numbers.map(Number);
    const known = turned.some((other) => other.joint === joint);
    if (!joint || known || by.length !== 3 || !(Math.hypot(...by) <= 180)) return undefined;
    turned.push({ joint, by: by as unknown as Vector });
  }
  return turned;
}

/** Rotation of a joint, radians. */
export function turnOf(turned: readonly TurnedJoint[], joint: Role): Vector {
  const [x, y, z] = turned.find((one) => one.joint === joint)?.by ?? [0, 0, 0];
  return [x / DEGREES, y / DEGREES, z / DEGREES];
}

/** The list with a joint's rotation, in radians, replaced. */
export function withTurn(turned: readonly TurnedJoint[], joint: Role, [x, y, z]: Vector): readonly TurnedJoint[] {
  const others = turned.filter((one) => one.joint !== joint);
  const by: Vector = [x * DEGREES, y * DEGREES, z * DEGREES];
  return by.every((angle) => Math.abs(angle) < 0.05) ? others : [...others, { joint, by }];
}

/** In the engine's format. */
export function turnsOf(turned: readonly TurnedJoint[]): Turn[] {
  return turned.map(({ joint }) => ({ joint: JOINT[joint], by: turnOf(turned, joint) }));
}
