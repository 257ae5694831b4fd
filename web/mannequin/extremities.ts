/** The left hand (palm, four curled fingers, an opposed thumb) and the left foot (shoe, toe, soles). */

import { type LoftOptions, loft, orient, type Station, type Surface } from "./loft";
import type { Part, SideSlot } from "./part";
import type { Vec3 } from "./vectors";

/** Height of the ankle above the ground in the T-pose of the mannequin's own proportions, metres. */
export const ANKLE_HEIGHT = 0.118;
/** Height of the toe joint above the ground, metres. */
export const TOE_HEIGHT = 0.034;

// The hand is drawn as it hangs: x lateral (away from the palm), y towards the fingertips, z towards the thumb.
const HAND_BASIS: readonly [Vec3, Vec3, Vec3] = [
  [0, 1, 0],
  [1, 0, 0],
  [0, 0, 1],
];
const PALM: Station[] = [
  [0.006, 0.014, 0.014, 0.024, 0.024],
  [0.03, 0.0145, 0.0155, 0.034, 0.032, 0, 0.001],
  [0.06, 0.013, 0.0145, 0.04, 0.036, 0, 0.002],
  [0.088, 0.0105, 0.012, 0.039, 0.037, 0, 0.001],
  [0.098, 0.009, 0.01, 0.037, 0.036],
];

/** A finger: knuckle across the palm and along the hand, length relative to the middle finger, relative thickness. */
type Finger = readonly [z: number, y: number, length: number, thickness: number];
const FINGERS: readonly Finger[] = [
  [0.0295, 0, 0.9, 1],
  [0.0105, 0.003, 1, 1],
  [-0.0095, 0.001, 0.95, 1],
  [-0.0275, -0.006, 0.76, 0.88],
];
/** Lengths and radii of the middle finger's phalanges, metres. */
const PHALANGES = [0.04, 0.025, 0.02] as const;
const FINGER_RADII = [0.0088, 0.008, 0.0074, 0.0062] as const;
const THUMB = [0.042, 0.03, 0.024] as const;
const THUMB_RADII = [0.012, 0.0098, 0.0088, 0.0072] as const;
/** Bend at the second and third knuckle: 20° and 17°. */
const CURL = [0.36, 0.3] as const;

function rotated([x, y, z]: Vec3, axis: "x" | "z", angle: number): Vec3 {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return axis === "x" ? [x, c * y - s * z, s * y + c * z] : [c * x - s * y, s * x + c * y, z];
}

function normalized([x, y, z]: Vec3): Vec3 {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** A capsule-like phalanx from `origin` along `direction`. */
function phalanx(origin: Vec3, direction: Vec3, length: number, r0: number, r1: number, detail: number): Surface {
  const middle = (r0 + r1) / 2;
  const stations: Station[] = [
    [-r0 * 0.2, r0, r0, r0, r0],
    [length * 0.5, middle, middle, middle, middle],
    [length + r1 * 0.7, r1, r1, r1, r1],
  ];
  const surface = loft(stations, {
    startCap: r0 * 0.8,
    endCap: r1 * 0.95,
    exponent: 2,
    rings: 2,
    capRings: 3,
    segments: 10,
    detail,
  });
  const helper: Vec3 = Math.abs(direction[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const u = normalized(cross(direction, helper));
  return orient(surface, [u, direction, cross(u, direction)], origin);
}

function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** A chain of phalanges; `curl` bends towards the palm (−x) before the second and the third. */
function finger(
  origin: Vec3,
  direction: Vec3,
  lengths: readonly number[],
  radii: readonly number[],
  curl: readonly number[],
  detail: number,
): Surface[] {
  let [at, towards] = [origin, direction];
  return lengths.map((length, i) => {
    const surface = phalanx(at, towards, length, radii[i]!, radii[i + 1]!, detail);
    at = [at[0] + towards[0] * length, at[1] + towards[1] * length, at[2] + towards[2] * length];
    towards = rotated(towards, "z", curl[i] ?? 0);
    return surface;
  });
}

function hand(detail: number): Surface[] {
  const fingers = FINGERS.flatMap(([z, y, length, thickness], i) => {
    const spread = rotated(rotated([0, 1, 0], "z", 0.16 + 0.05 * i), "x", 0.03 - 0.022 * i);
    return finger(
      [-0.002, 0.09 + y, z],
      spread,
      PHALANGES.map((l) => l * length),
      FINGER_RADII.map((r) => r * thickness),
      CURL,
      detail,
    );
  });
  const thumb = finger([-0.006, 0.026, 0.022], normalized([-0.38, 0.7, 0.6]), THUMB, THUMB_RADII, [], detail);
  const palm = loft(PALM, {
    startCap: 0.012,
    endCap: 0.01,
    exponent: 2.6,
    rings: 8,
    capRings: 4,
    segments: 24,
    detail,
  });
  return [palm, ...fingers, ...thumb].map((surface) => orient(surface, HAND_BASIS));
}

// The foot is lofted from heel to toe: u lateral, along forwards, w up.
const FOOT_BASIS: readonly [Vec3, Vec3, Vec3] = [
  [1, 0, 0],
  [0, 0, 1],
  [0, 1, 0],
];

/** A foot part whose stations' w are heights above the ground. */
function footLoft(stations: readonly Station[], jointHeight: number, options: Partial<LoftOptions>): Surface {
  return orient(loft(stations, { exponent: 2.5, segments: 28, rings: 10, ...options }), FOOT_BASIS, [
    0,
    -jointHeight,
    0,
  ]);
}

const SHOE: Station[] = [
  [-0.066, 0.027, 0.025, 0.04, 0.036, 0, 0.036],
  [-0.045, 0.032, 0.03, 0.055, 0.036, 0, 0.036],
  [-0.01, 0.033, 0.031, 0.075, 0.034, 0, 0.034],
  [0.03, 0.036, 0.033, 0.062, 0.03, 0.002, 0.03],
  [0.07, 0.041, 0.037, 0.044, 0.026, 0.003, 0.026],
  [0.105, 0.045, 0.041, 0.032, 0.022, 0.003, 0.022],
  [0.133, 0.046, 0.041, 0.026, 0.02, 0.003, 0.02],
];
const TOE: Station[] = [
  [-0.006, 0.046, 0.041, 0.025, 0.02, 0.003, 0.02],
  [0.02, 0.046, 0.043, 0.023, 0.018, 0.002, 0.018],
  [0.05, 0.04, 0.042, 0.018, 0.015, -0.003, 0.015],
  [0.072, 0.03, 0.036, 0.013, 0.012, -0.006, 0.012],
];
const SHOE_SOLE: Station[] = [
  [-0.068, 0.027, 0.025, 0.008, 0.006, 0, 0.006],
  [-0.045, 0.033, 0.031, 0.009, 0.006, 0, 0.006],
  [0, 0.034, 0.028, 0.009, 0.006, 0.002, 0.006],
  [0.05, 0.04, 0.033, 0.009, 0.006, 0.004, 0.006],
  [0.105, 0.0465, 0.0415, 0.009, 0.006, 0.003, 0.006],
  [0.133, 0.0468, 0.0415, 0.009, 0.006, 0.003, 0.006],
];
const TOE_SOLE: Station[] = [
  [-0.006, 0.0468, 0.0415, 0.007, 0.006, 0.003, 0.006],
  [0.02, 0.0468, 0.0435, 0.006, 0.006, 0.002, 0.006],
  [0.05, 0.0408, 0.0425, 0.005, 0.006, -0.003, 0.006],
  [0.0735, 0.0305, 0.0365, 0.004, 0.006, -0.006, 0.006],
];

/** Parts of the left hand and foot. */
export function extremities(detail: number): Part<SideSlot>[] {
  return [
    ...hand(detail).map((surface): Part<SideSlot> => ({ slot: "hand", tone: "shell", surface })),
    {
      slot: "foot",
      tone: "shell",
      surface: footLoft(SHOE, ANKLE_HEIGHT, { startCap: 0.022, endCap: 0.012, detail }),
    },
    {
      slot: "foot",
      tone: "joint",
      surface: footLoft(SHOE_SOLE, ANKLE_HEIGHT, { startCap: 0.022, endCap: 0.012, detail }),
    },
    {
      slot: "toes",
      tone: "shell",
      surface: footLoft(TOE, TOE_HEIGHT, { startCap: 0.01, endCap: 0.03, rings: 6, detail }),
    },
    {
      slot: "toes",
      tone: "joint",
      surface: footLoft(TOE_SOLE, TOE_HEIGHT, { startCap: 0.01, endCap: 0.03, rings: 4, detail }),
    },
  ];
}
