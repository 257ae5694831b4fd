/**
 * Fits the mannequin to any proportions.
 *
 * One rule: *from the hips down the bones are the motion's, from the hips up they are the mannequin's own*, times the
 * stature (the ratio of leg lengths). Feet therefore meet the ground exactly as in the data, up to the toe joint. Above
 * the hips, motion capture skeletons have collars and shoulders in many different places, some inside the chest, which
 * no shell covers well. Rotations mean the same on every skeleton, so the mannequin's own lengths show the same
 * gesture.
 *
 * Leg shells are stretched along their bone to its length, and across it by the geometric mean of that stretch and of
 * the stature, so that a short bone neither balloons nor becomes a thread. Shoe and toe have the heights of ankle and
 * toe joint in the T-pose, which puts the soles on its ground for all proportions.
 */

import { DEFAULT_PROPORTIONS, JOINT, JOINTS, type Role } from "../humanoid";
import { ANKLE_HEIGHT, TOE_HEIGHT } from "./extremities";
import { SIDE_SLOTS, type SideSlot, type Slot } from "./part";
import { RIGID_SLOTS, slotIndex } from "./slots";
import {
  composeInto,
  difference,
  lengthOf,
  NO_TURN,
  product,
  type Quat,
  scaled,
  sum,
  turnAboutUp,
  turnBetween,
  type Vec3,
} from "./vectors";
import { WAIST_END, WAIST_START } from "./waist";

/** The mannequin with one set of proportions. */
export interface Fit {
  /** The bones on which it is drawn: 21 × xyz offsets, metres. */
  proportions: Float32Array;
  /** For every rigid slot: the transform from the part's own coordinates to the joint's frame, 4 × 4, column-major. */
  jointFromSlot: Float32Array;
  /** Start of the waist in the hips' frame, metres. */
  waistStart: Vec3;
  /** End of the waist in the chest's frame, metres. */
  waistEnd: Vec3;
  /** Factors on the waist's half width and half depth at both ends. */
  waistScale: { start: [x: number, z: number]; end: [x: number, z: number] };
  /** Ratio of leg lengths to the mannequin's own. */
  stature: number;
}

/** Factors beyond which a shell would no longer look like a body part. */
const STRETCH = { min: 0.3, max: 3 };

const SIDES = ["left", "right"] as const;
const LEG_ROLES = ["upper_leg", "lower_leg", "foot", "toes"] as const;

function clampStretch(ratio: number): number {
  return Number.isFinite(ratio) ? Math.min(STRETCH.max, Math.max(STRETCH.min, ratio)) : 1;
}

function offsetOf(proportions: ArrayLike<number>, role: Role): Vec3 {
  const first = 3 * JOINT[role];
  return [proportions[first]!, proportions[first + 1]!, proportions[first + 2]!];
}

const own = (role: Role) => offsetOf(DEFAULT_PROPORTIONS, role);

const uniform = (factor: number): Vec3 => [factor, factor, factor];

function legLength(proportions: ArrayLike<number>): number {
  return lengthOf(offsetOf(proportions, "left_lower_leg")) + lengthOf(offsetOf(proportions, "left_foot"));
}

/** The given bones from the hips down, the mannequin's own times `stature` from the hips up. */
function drawnBones(proportions: ArrayLike<number>, stature: number): Float32Array {
  const bones = DEFAULT_PROPORTIONS.map((offset) => offset * stature);
  const legs = SIDES.flatMap((side) => LEG_ROLES.map((role) => JOINT[`${side}_${role}`]));
  for (const joint of [JOINT.hips, ...legs]) for (let i = 3 * joint; i < 3 * joint + 3; i++) bones[i] = proportions[i]!;
  return bones;
}

/** Scale of a leg's shell and the rotation from the mannequin's direction of the bone to the given one. */
function fitLegBone(proportions: ArrayLike<number>, child: Role, stature: number): { scale: Vec3; turn: Quat } {
  const [given, drawn] = [offsetOf(proportions, child), own(child)];
  const [length, drawnLength] = [lengthOf(given), lengthOf(drawn)];
  if (!(length > 1e-3)) return { scale: uniform(stature), turn: NO_TURN };
  const along = clampStretch(length / drawnLength);
  const across = clampStretch(Math.sqrt(along * stature));
  const turn = turnBetween(scaled(drawn, 1 / drawnLength), scaled(given, 1 / length));
  return { scale: [across, along, across], turn };
}

/**
 * Fits the mannequin to a body.
 *
 * @param given - Bone offsets, 21 × xyz, metres.
 * @throws RangeError if there are not 63 numbers.
 */
export function fitTo(given: ArrayLike<number>): Fit {
  if (given.length !== 3 * JOINTS) throw new RangeError(`expected ${3 * JOINTS} numbers, not ${given.length}`);
  const stature = clampStretch(legLength(given) / legLength(DEFAULT_PROPORTIONS));
  const proportions = drawnBones(given, stature);
  const at = (role: Role) => offsetOf(proportions, role);
  const jointFromSlot = new Float32Array(16 * RIGID_SLOTS.length);
  const origin: Vec3 = [0, 0, 0];
  const put = (slot: Slot, position: Vec3, turn: Quat, scale: Vec3) =>
    composeInto(jointFromSlot, 16 * slotIndex(slot), position, turn, scale);

  for (const slot of ["ribcage", "neck", "head"] as const) put(slot, origin, NO_TURN, uniform(stature));

  const hipWidth = at("left_upper_leg")[0] - at("right_upper_leg")[0];
  const widening = clampStretch(hipWidth / (2 * own("left_upper_leg")[0] * stature));
  const pelvisScale: Vec3 = [Math.sqrt(widening) * stature, stature, stature];
  const hipCentre = scaled(sum(at("left_upper_leg"), at("right_upper_leg")), 0.5);
  const ownHipCentre = product([0, own("left_upper_leg")[1], 0], pelvisScale);
  const pelvisPosition = difference(hipCentre, ownHipCentre);
  put("pelvis", pelvisPosition, NO_TURN, pelvisScale);

  for (const side of SIDES) {
    const slot = (name: SideSlot): Slot => `${side}_${name}`;
    for (const name of SIDE_SLOTS) put(slot(name), origin, NO_TURN, uniform(stature));
    const thigh = fitLegBone(proportions, `${side}_lower_leg`, stature);
    const shin = fitLegBone(proportions, `${side}_foot`, stature);
    put(slot("thigh"), origin, thigh.turn, thigh.scale);
    put(slot("knee_ball"), origin, NO_TURN, uniform(Math.sqrt(thigh.scale[0] * shin.scale[0])));
    put(slot("shin"), origin, shin.turn, shin.scale);
    put(slot("ankle_ball"), origin, NO_TURN, uniform(shin.scale[0]));

    const ankle = at("hips")[1] + LEG_ROLES.slice(0, 3).reduce((height, role) => height + at(`${side}_${role}`)[1], 0);
    const [toesX, toesY, toesZ] = at(`${side}_toes`);
    const rise = clampStretch(ankle / ANKLE_HEIGHT);
    const reach = clampStretch(Math.hypot(toesX, toesZ) / own(`${side}_toes`)[2]);
    const heading = turnAboutUp(Math.atan2(toesX, toesZ));
    const width = Math.sqrt(reach * stature);
    // The sole is on the ground, even if the height of the shoe was clamped.
    put(slot("foot"), [0, ANKLE_HEIGHT * rise - ankle, 0], heading, [width, rise, reach]);
    put(slot("toes"), [0, TOE_HEIGHT * rise - ankle - toesY, 0], heading, [width, rise, stature]);
  }
  return {
    proportions,
    jointFromSlot,
    waistStart: sum(product(WAIST_START, pelvisScale), pelvisPosition),
    waistEnd: scaled(WAIST_END, stature),
    waistScale: { start: [pelvisScale[0], pelvisScale[2]], end: [stature, stature] },
    stature,
  };
}
