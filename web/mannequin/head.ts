/** The head and the dark plate that shows its orientation. */

import { atDetail, capFactor, loft, type Section, type Station, type Surface, sectionAt, superellipse } from "./loft";
import type { MidlineSlot, Part } from "./part";

// Heights above the skull's base joint; w is the front.
const HEAD: Station[] = [
  [-0.034, 0.03, 0.03, 0.026, 0.03, 0, 0.046],
  [-0.02, 0.044, 0.044, 0.044, 0.05, 0, 0.036],
  [0.006, 0.056, 0.056, 0.066, 0.066, 0, 0.024],
  [0.036, 0.0645, 0.0645, 0.078, 0.08, 0, 0.018],
  [0.07, 0.0715, 0.0715, 0.083, 0.092, 0, 0.012],
  [0.105, 0.076, 0.076, 0.086, 0.098, 0, 0.006],
  [0.14, 0.0745, 0.0745, 0.085, 0.0955, 0, 0.001],
  [0.17, 0.0665, 0.0665, 0.075, 0.084, 0, -0.002],
  [0.19, 0.055, 0.055, 0.062, 0.068, 0, -0.004],
  [0.206, 0.043, 0.043, 0.048, 0.052, 0, -0.005],
];
const HEAD_SHAPE = { startCap: 0.014, endCap: 0.036, exponent: 2.12 };

/** Centre height, half height (metres), half width (radians about the head's axis) and taper towards the chin. */
const PLATE = { centre: 0.063, halfHeight: 0.066, halfAngle: 0.76, taper: 0.26, exponent: 2.25 };
/** Start of the rays that place the plate: on the head's axis, in front of the joint. */
const AXIS_Z = 0.012;
/** Height of the plate over the head's surface, and depth of its rim in the head, metres. */
const PLATE_THICKNESS = 0.003;
const PLATE_INSET = 0.0006;

/** Distance from the head's axis to its surface at a height, in the direction `angle` from the front. */
function headRadius(height: number, angle: number): number {
  const [, uPlus, uMinus, wPlus, wMinus, u0, w0]: Section = sectionAt(HEAD, height);
  const k = capFactor(height, HEAD[0]![0], HEAD.at(-1)![0], HEAD_SHAPE.startCap, HEAD_SHAPE.endCap);
  const outside = (r: number) => {
    const u = Math.sin(angle) * r - u0;
    const w = AXIS_Z + Math.cos(angle) * r - w0;
    const e = HEAD_SHAPE.exponent;
    return Math.abs(u / (u > 0 ? uPlus : uMinus)) ** e + Math.abs(w / (w > 0 ? wPlus : wMinus)) ** e > k ** e;
  };
  let [inner, outer] = [0, 0.2];
  for (let i = 0; i < 24; i++) {
    const middle = (inner + outer) / 2;
    if (outside(middle)) outer = middle;
    else inner = middle;
  }
  return inner;
}

/** A rounded mask draped over the front of the head: concentric rings around its middle, the rim sunk into the head. */
function facePlate(detail: number): Surface {
  const rings = atDetail(10, detail);
  const segments = atDetail(40, detail);
  const surface: Surface = { positions: [], indices: [] };
  const { positions, indices } = surface;
  const push = (share: number, around: number) => {
    const [ux, uy] = superellipse(around, PLATE.exponent);
    const x = ux * share;
    const y = uy * share;
    const height = PLATE.centre + y * PLATE.halfHeight;
    const angle = x * PLATE.halfAngle * (1 - PLATE.taper * (1 - y) * 0.5);
    const lift = PLATE_THICKNESS * Math.sqrt(Math.min(1, (1 - share) / 0.08)) - PLATE_INSET;
    const r = headRadius(height, angle) + lift;
    positions.push(Math.sin(angle) * r, height, AXIS_Z + Math.cos(angle) * r);
  };
  push(0, 0);
  // The rim rounds off within the last share of the radius, so rings crowd there.
  const shares = Array.from({ length: rings }, (_, i) => Math.sin((((i + 1) / rings) * Math.PI) / 2));
  for (const share of shares) for (let j = 0; j < segments; j++) push(share, (j / segments) * 2 * Math.PI);
  const ring = (i: number, j: number) => 1 + i * segments + (j % segments);
  for (let j = 0; j < segments; j++) indices.push(0, ring(0, j), ring(0, j + 1));
  for (let i = 0; i + 1 < rings; i++)
    for (let j = 0; j < segments; j++)
      indices.push(ring(i, j), ring(i + 1, j), ring(i, j + 1), ring(i, j + 1), ring(i + 1, j), ring(i + 1, j + 1));
  return surface;
}

/** Head and face plate. */
export function headParts(detail: number): Part<MidlineSlot>[] {
  const head = loft(HEAD, { ...HEAD_SHAPE, rings: 24, capRings: 7, segments: 40, detail });
  return [
    { slot: "head", tone: "shell", surface: head },
    { slot: "head", tone: "joint", surface: facePlate(detail) },
  ];
}
