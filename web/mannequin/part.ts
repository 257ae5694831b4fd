/** A part of the mannequin and the slots that parts follow: rigid frames, each fixed to a joint. */

import type { Surface } from "./loft";

/** Rigid frames on the body's midline. */
export const MIDLINE_SLOTS = ["pelvis", "ribcage", "neck", "head"] as const;
/** Rigid frames that exist on both sides, named for one. */
export const SIDE_SLOTS = [
  "clavicle",
  "shoulder_ball",
  "upper_arm",
  "elbow_ball",
  "forearm",
  "wrist_ball",
  "hand",
  "thigh",
  "knee_ball",
  "shin",
  "ankle_ball",
  "foot",
  "toes",
] as const;

/** Name of a midline slot. */
export type MidlineSlot = (typeof MIDLINE_SLOTS)[number];
/** Name of a slot that exists on both sides. */
export type SideSlot = (typeof SIDE_SLOTS)[number];
/** A rigid frame: a midline one by name, a limb's with its side, the waist's by the ring's index. */
export type Slot = MidlineSlot | `${"left" | "right"}_${SideSlot}` | `waist_${number}`;

/** Which of the two materials a part has. */
export type Tone = "shell" | "joint";

/** One part of the body. */
export interface Part<S extends string = Slot> {
  slot: S;
  tone: Tone;
  surface: Surface;
}
