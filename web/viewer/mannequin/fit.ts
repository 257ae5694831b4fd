/**
 * Fits the mannequin to anyone's proportions.
 *
 * One rule: *from the hips down the bones are the motion's, from the hips up they are the mannequin's own*, times the
 * stature (the ratio of leg lengths). Feet therefore meet the ground exactly where the data says, to the toe joint. Above,
 * motion capture skeletons put collars and shoulders in many different places, some inside the chest, which no shell
 * covers well; rotations mean the same on every skeleton, so the mannequin's own lengths show the same gesture.
 *
 * Leg shells are stretched along their bone to its length, and across it by the geometric mean of that stretch and of the
 * stature, so that a short bone neither balloons nor becomes a thread. Shoe and toe take the heights of ankle and toe
 * joint in the T-pose, which puts the soles on its ground whatever the proportions.
 */

import { Matrix4, Quaternion, Vector3 } from "three";
import { DEFAULT_PROPORTIONS, JOINT, JOINTS, type Role } from "../../humanoid";
import { ANKLE_HEIGHT, TOE_HEIGHT } from "./extremities";
import { SIDE_SLOTS, type SideSlot, type Slot } from "./part";
import { RIGID_SLOTS, slotIndex } from "./slots";
import { WAIST_END, WAIST_START } from "./waist";

/** The mannequin on one set of proportions. */
export interface Fit {
  /** The bones it is drawn on: 21 × xyz offsets, metres. */
  proportions: Float32Array;
  /** Of every rigid slot: the frame of its joint from the part's own coordinates, 4 × 4, column-major. */
  jointFromSlot: Float32Array;
  /** Where the waist starts in the hips' frame, metres. */
  waistStart: Vector3;
  /** Where it ends in the chest's frame, metres. */
  waistEnd: Vector3;
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

function offsetOf(proportions: ArrayLike<number>, role: Role): Vector3 {
  const [x, y, z] = [0, 1, 2].map((axis) => proportions[3 * JOINT[role] + axis]!);
  return new Vector3(x, y, z);
}

const own = (role: Role) => offsetOf(DEFAULT_PROPORTIONS, role);

function legLength(proportions: ArrayLike<number>): number {
  return offsetOf(proportions, "left_lower_leg").length() + offsetOf(proportions, "left_foot").length();
}

/** The given bones from the hips down, the mannequin's own times `stature` from the hips up. */
function drawnBones(proportions: ArrayLike<number>, stature: number): Float32Array {
  const bones = DEFAULT_PROPORTIONS.map((offset) => offset * stature);
  const legs = SIDES.flatMap((side) => LEG_ROLES.map((role) => JOINT[`${side}_${role}`]));
  for (const joint of [JOINT.hips, ...legs]) for (let i = 3 * joint; i < 3 * joint + 3; i++) bones[i] = proportions[i]!;
  return bones;
}

/** Scale of a leg's shell and the turn from the mannequin's direction of the bone to the given one. */
function fitLegBone(
  proportions: ArrayLike<number>,
  child: Role,
  stature: number,
): { scale: Vector3; turn: Quaternion } {
  const given = offsetOf(proportions, child);
  const length = given.length();
  if (!(length > 1e-3)) return { scale: new Vector3(stature, stature, stature), turn: new Quaternion() };
  const along = clampStretch(length / own(child).length());
  const across = clampStretch(Math.sqrt(along * stature));
  const turn = new Quaternion().setFromUnitVectors(own(child).normalize(), given.divideScalar(length));
  return { scale: new Vector3(across, along, across), turn };
}

/** Fits the mannequin to 21 × xyz offsets in metres. */
export function fitTo(given: ArrayLike<number>): Fit {
  if (given.length !== 3 * JOINTS) throw new RangeError(`expected ${3 * JOINTS} numbers, not ${given.length}`);
  const stature = clampStretch(legLength(given) / legLength(DEFAULT_PROPORTIONS));
  const proportions = drawnBones(given, stature);
  const at = (role: Role) => offsetOf(proportions, role);
  const jointFromSlot = new Float32Array(16 * RIGID_SLOTS.length);
  const origin = new Vector3();
  const none = new Quaternion();
  const uniform = (factor: number) => new Vector3(factor, factor, factor);
  const put = (slot: Slot, position: Vector3, turn: Quaternion, scale: Vector3) =>
    new Matrix4().compose(position, turn, scale).toArray(jointFromSlot, 16 * slotIndex(slot));

  for (const slot of ["ribcage", "neck", "head"] as const) put(slot, origin, none, uniform(stature));

  const hipWidth = at("left_upper_leg").x - at("right_upper_leg").x;
  const widening = clampStretch(hipWidth / (2 * own("left_upper_leg").x * stature));
  const pelvisScale = new Vector3(Math.sqrt(widening), 1, 1).multiplyScalar(stature);
  const hipCentre = at("left_upper_leg").add(at("right_upper_leg")).multiplyScalar(0.5);
  const ownHipCentre = new Vector3(0, own("left_upper_leg").y, 0).multiply(pelvisScale);
  const pelvisPosition = hipCentre.sub(ownHipCentre);
  put("pelvis", pelvisPosition, none, pelvisScale);

  for (const side of SIDES) {
    const slot = (name: SideSlot): Slot => `${side}_${name}`;
    for (const name of SIDE_SLOTS) put(slot(name), origin, none, uniform(stature));
    const thigh = fitLegBone(proportions, `${side}_lower_leg`, stature);
    const shin = fitLegBone(proportions, `${side}_foot`, stature);
    put(slot("thigh"), origin, thigh.turn, thigh.scale);
    put(slot("knee_ball"), origin, none, uniform(Math.sqrt(thigh.scale.x * shin.scale.x)));
    put(slot("shin"), origin, shin.turn, shin.scale);
    put(slot("ankle_ball"), origin, none, uniform(shin.scale.x));

    const ankle = at("hips").y + LEG_ROLES.slice(0, 3).reduce((sum, role) => sum + at(`${side}_${role}`).y, 0);
    const toes = at(`${side}_toes`);
    const rise = clampStretch(ankle / ANKLE_HEIGHT);
    const reach = clampStretch(Math.hypot(toes.x, toes.z) / own(`${side}_toes`).z);
    const heading = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), Math.atan2(toes.x, toes.z));
    const width = Math.sqrt(reach * stature);
    // Whatever the clamp did to the height of the shoe, its sole is on the ground.
    put(slot("foot"), new Vector3(0, ANKLE_HEIGHT * rise - ankle, 0), heading, new Vector3(width, rise, reach));
    put(
      slot("toes"),
      new Vector3(0, TOE_HEIGHT * rise - ankle - toes.y, 0),
      heading,
      new Vector3(width, rise, stature),
    );
  }
  return {
    proportions,
    jointFromSlot,
    waistStart: new Vector3(...WAIST_START).multiply(pelvisScale).add(pelvisPosition),
    waistEnd: new Vector3(...WAIST_END).multiplyScalar(stature),
    waistScale: { start: [pelvisScale.x, pelvisScale.z], end: [stature, stature] },
    stature,
  };
}
