/** The state of figures about the degrees of freedom of a pose. */

import type { LearnInput } from "../../client/learn/protocol";
import type { Role } from "../../humanoid";
import { DEGREES } from "../../humanoid";
import { choice, type Fields, number } from "../../link/fields";
import type { DialRange } from "../../ui/controls/dial";
import { INPUTS, type InputName } from "../built_in";
import { LIMBS } from "../limb_handles";
import { type TurnedJoint, turnedJoints, turnsOf } from "../turned_joints";

/** Joints that can be read. */
export const READ: readonly Role[] = LIMBS.map(([joint]) => joint);

/** Which joint of which pose is read, and in which axes. */
export interface PoseState {
  motion: InputName;
  /** Frame of the input. */
  at: number;
  joint: Role;
  /** Limbs that are rotated in every frame. */
  turned: readonly TurnedJoint[];
  /** Rotation of the whole body about the vertical, degrees. */
  heading: number;
  /** φ: rotation of the joint's own axes about its x axis, degrees. */
  phi: number;
}

/** The knobs. */
export const POSE_RANGES = {
  heading: { min: -180, max: 180, digits: 0, scale: "linear" },
  phi: { min: 0, max: 180, digits: 0, scale: "linear" },
} as const satisfies Record<string, DialRange>;

/** Range of a component of w, degrees. */
export const COMPONENT: DialRange = { min: -180, max: 180, digits: 0, scale: "linear" };

/** Encoding of the state in a link. */
export const POSE_FIELDS: Fields<PoseState> = {
  motion: choice("motion", "neutral walk", INPUTS, true),
  at: number("i", 160, { min: 0, max: 5000, digits: 0 }, true),
  joint: choice("joint", "left_lower_leg", READ, true),
  turned: turnedJoints("turned"),
  heading: number("heading", 0, POSE_RANGES.heading, true),
  phi: number("phi", 0, POSE_RANGES.phi, true),
};

/** The input rotated as in a state. */
export function inputOf({ motion, turned, heading }: Pick<PoseState, "motion" | "turned" | "heading">): LearnInput {
  return {
    name: motion,
    ...(turned.length > 0 && { turns: turnsOf(turned) }),
    ...(heading !== 0 && { heading: heading / DEGREES }),
  };
}
