/** The rigid frames that carry the parts: their order, and the joint that each one follows. */

import { JOINT, type Role } from "../humanoid";
import { MIDLINE_SLOTS, type MidlineSlot, SIDE_SLOTS, type SideSlot, type Slot } from "./part";
import { WAIST_RINGS, waistSlot } from "./waist";

const SIDES = ["left", "right"] as const;

const MIDLINE_JOINT: Record<MidlineSlot, Role> = { pelvis: "hips", ribcage: "chest", neck: "neck", head: "head" };
const SIDE_JOINT = {
  clavicle: "shoulder",
  shoulder_ball: "upper_arm",
  upper_arm: "upper_arm",
  elbow_ball: "lower_arm",
  forearm: "lower_arm",
  wrist_ball: "hand",
  hand: "hand",
  thigh: "upper_leg",
  knee_ball: "lower_leg",
  shin: "lower_leg",
  ankle_ball: "foot",
  foot: "foot",
  toes: "toes",
} as const satisfies Record<SideSlot, string>;

/** Slots that follow one joint, in the order of the bone matrices. */
export const RIGID_SLOTS: readonly Slot[] = [
  ...MIDLINE_SLOTS,
  ...SIDES.flatMap((side) => SIDE_SLOTS.map((slot): Slot => `${side}_${slot}`)),
];

/** All slots: the rigid ones, then the waist's rings. */
export const SLOTS: readonly Slot[] = [...RIGID_SLOTS, ...Array.from({ length: WAIST_RINGS }, (_, i) => waistSlot(i))];

/** Index of a slot among the bone matrices. */
export function slotIndex(slot: Slot): number {
  return SLOTS.indexOf(slot);
}

/** Joint that each rigid slot follows. */
export const SLOT_JOINTS: Readonly<Uint8Array> = Uint8Array.from([
  ...MIDLINE_SLOTS.map((slot) => JOINT[MIDLINE_JOINT[slot]]),
  ...SIDES.flatMap((side) => SIDE_SLOTS.map((slot) => JOINT[`${side}_${SIDE_JOINT[slot]}`])),
]);
