/**
 * The parts of the mannequin: each is a surface in the T-pose frame of one slot (a rigid frame that follows a joint,
 * see `fit.ts`) and in one of two tones. Left parts are defined, right parts are their mirror images.
 */

import { extremities } from "./extremities";
import { headParts } from "./head";
import { ball, type LoftOptions, loft, mirror, orient, type Station } from "./loft";
import type { MidlineSlot, Part, SideSlot, Tone } from "./part";
import type { Vec3 } from "./vectors";
import { waistParts } from "./waist";

const UP: Vec3 = [0, 1, 0];
const DOWN: Vec3 = [0, -1, 0];
const LEFT: Vec3 = [1, 0, 0];
const FRONT: Vec3 = [0, 0, 1];
const BACK: Vec3 = [0, 0, -1];

/** Axes of the stations: u is lateral, along runs down the bone, w is the front. */
const LEG_BASIS = [LEFT, DOWN, FRONT] as const;
const ARM_BASIS = [UP, LEFT, FRONT] as const;
/** The collar's stations have u up and w to the back. */
const COLLAR_BASIS = [UP, LEFT, BACK] as const;

const THIGH: Station[] = [
  [-0.015, 0.07, 0.06, 0.074, 0.078, 0.006, 0],
  [0.06, 0.078, 0.07, 0.08, 0.082, 0.005, 0.002],
  [0.13, 0.074, 0.07, 0.079, 0.077, 0.004, 0.006],
  [0.22, 0.064, 0.061, 0.069, 0.063, 0.002, 0.01],
  [0.3, 0.054, 0.051, 0.057, 0.051, 0, 0.008],
  [0.352, 0.047, 0.046, 0.049, 0.045, 0, 0.003],
  [0.372, 0.045, 0.044, 0.047, 0.042],
];
const SHIN: Station[] = [
  [0.02, 0.043, 0.042, 0.044, 0.043, 0, 0.004],
  [0.06, 0.045, 0.043, 0.044, 0.05],
  [0.115, 0.049, 0.047, 0.042, 0.062, 0, -0.004],
  [0.165, 0.047, 0.046, 0.041, 0.06, 0, -0.006],
  [0.235, 0.038, 0.037, 0.036, 0.045, 0, -0.004],
  [0.31, 0.0315, 0.031, 0.031, 0.034, 0, -0.002],
  [0.384, 0.0295, 0.0295, 0.031, 0.033],
];
const UPPER_ARM: Station[] = [
  [-0.05, 0.042, 0.04, 0.048, 0.048],
  [0, 0.052, 0.042, 0.053, 0.053],
  [0.05, 0.05, 0.04, 0.05, 0.05, 0.001],
  [0.11, 0.041, 0.037, 0.045, 0.043, 0, 0.002],
  [0.18, 0.035, 0.034, 0.039, 0.036, 0, 0.002],
  [0.235, 0.0315, 0.0315, 0.033, 0.032, 0, 0.001],
  [0.254, 0.03, 0.031, 0.032, 0.031],
];
const FOREARM: Station[] = [
  [0.016, 0.031, 0.031, 0.032, 0.032],
  [0.055, 0.035, 0.034, 0.036, 0.035],
  [0.1, 0.034, 0.032, 0.035, 0.034],
  [0.165, 0.027, 0.025, 0.029, 0.028],
  [0.222, 0.021, 0.02, 0.026, 0.025],
];
const COLLAR: Station[] = [
  [-0.03, 0.024, 0.06, 0.04, 0.046, -0.014, -0.006],
  [0.03, 0.034, 0.068, 0.054, 0.056, -0.012, -0.006],
  [0.08, 0.042, 0.062, 0.055, 0.056, -0.006, -0.004],
  [0.132, 0.047, 0.05, 0.048, 0.049],
];
const PELVIS: Station[] = [
  [-0.098, 0.052, 0.052, 0.056, 0.06, 0, -0.004],
  [-0.07, 0.098, 0.098, 0.08, 0.09, 0, -0.006],
  [-0.03, 0.142, 0.142, 0.094, 0.106, 0, -0.008],
  [0.015, 0.144, 0.144, 0.092, 0.102, 0, -0.006],
  [0.055, 0.13, 0.13, 0.086, 0.09, 0, -0.003],
  [0.1, 0.1165, 0.1165, 0.0805, 0.0805, 0, -0.001],
];
const RIBCAGE: Station[] = [
  [-0.082, 0.108, 0.108, 0.082, 0.076, 0, 0.002],
  [-0.045, 0.116, 0.116, 0.09, 0.084, 0, 0.004],
  [0, 0.129, 0.129, 0.102, 0.092, 0, 0.003],
  [0.05, 0.143, 0.143, 0.11, 0.1, 0, -0.001],
  [0.095, 0.146, 0.146, 0.106, 0.102, 0, -0.006],
  [0.128, 0.134, 0.134, 0.092, 0.094, 0, -0.01],
  [0.155, 0.104, 0.104, 0.072, 0.08, 0, -0.012],
  [0.178, 0.07, 0.07, 0.056, 0.062, 0, -0.01],
  [0.2, 0.05, 0.05, 0.048, 0.05, 0, -0.004],
];
const NECK: Station[] = [
  [-0.03, 0.048, 0.048, 0.046, 0.048, 0, -0.002],
  [0.02, 0.045, 0.045, 0.044, 0.046],
  [0.07, 0.044, 0.044, 0.044, 0.045, 0, 0.004],
  [0.12, 0.046, 0.046, 0.046, 0.048, 0, 0.004],
];

function midlineParts(detail: number): Part<MidlineSlot>[] {
  const pelvis = loft(PELVIS, { startCap: 0.03, endCap: 0.004, exponent: 2.3, segments: 40, detail });
  const ribcage = loft(RIBCAGE, { startCap: 0.012, endCap: 0.012, exponent: 2.35, segments: 44, rings: 26, detail });
  const neck = loft(NECK, { startCap: 0.01, endCap: 0.01, exponent: 2.1, segments: 24, rings: 8, capRings: 2, detail });
  return [
    { slot: "pelvis", tone: "joint", surface: pelvis },
    { slot: "ribcage", tone: "shell", surface: ribcage },
    { slot: "neck", tone: "joint", surface: neck },
  ];
}

function limbParts(detail: number): Part<SideSlot>[] {
  const leg = (slot: SideSlot, stations: Station[], options: Partial<LoftOptions>): Part<SideSlot> => ({
    slot,
    tone: "shell",
    surface: orient(loft(stations, { detail, ...options }), LEG_BASIS),
  });
  const arm = (slot: SideSlot, stations: Station[], options: Partial<LoftOptions>): Part<SideSlot> => ({
    slot,
    tone: "shell",
    surface: orient(loft(stations, { detail, ...options }), ARM_BASIS),
  });
  const joint = (slot: SideSlot, radius: number, tone: Tone = "joint"): Part<SideSlot> => ({
    slot,
    tone,
    surface: ball(radius, detail),
  });
  return [
    leg("thigh", THIGH, { startCap: 0.05, endCap: 0.022, exponent: 2.1, segments: 32 }),
    joint("knee_ball", 0.0445),
    leg("shin", SHIN, { startCap: 0.02, endCap: 0.01, rings: 16 }),
    joint("ankle_ball", 0.0325),
    {
      slot: "clavicle",
      tone: "shell",
      surface: orient(
        loft(COLLAR, { startCap: 0.03, endCap: 0.035, exponent: 2.1, segments: 24, rings: 6, detail }),
        COLLAR_BASIS,
      ),
    },
    joint("shoulder_ball", 0.0475, "shell"),
    arm("upper_arm", UPPER_ARM, { startCap: 0.05, endCap: 0.012, exponent: 2.1, segments: 24 }),
    joint("elbow_ball", 0.0315),
    arm("forearm", FOREARM, { startCap: 0.014, endCap: 0.01, segments: 24, rings: 10 }),
    joint("wrist_ball", 0.0215),
  ];
}

/** The parts of both sides, from those of the left. */
function bothSides(parts: readonly Part<SideSlot>[]): Part[] {
  return parts.flatMap(({ slot, tone, surface }): Part[] => [
    { slot: `left_${slot}`, tone, surface },
    { slot: `right_${slot}`, tone, surface: mirror(surface) },
  ]);
}

/** Groups of parts of the body at a level of detail (see `LoftOptions.detail`), each made on demand. */
export function* partGroups(detail: number): Generator<Part[]> {
  yield midlineParts(detail);
  yield headParts(detail);
  yield waistParts(detail);
  yield bothSides(limbParts(detail));
  yield bothSides(extremities(detail));
}

/** Every part of the body at a level of detail. */
export function bodyParts(detail: number): Part[] {
  return [...partGroups(detail)].flat();
}
