/**
 * The waist: one tube between pelvis and ribcage that bends without a seam. Each of its rings is a slot of its own,
 * placed every frame along a Bézier curve (see `fit.ts`), so that the bend costs a few matrices and no new vertices.
 */

import { atDetail, type Station, type Surface, sectionAt, superellipse } from "./loft";
import type { Part, Slot } from "./part";

/** Number of rings, the first in the pelvis, the last in the ribcage. */
export const WAIST_RINGS = 13;
/** Start of the curve, in the pelvis's frame, metres. */
export const WAIST_START = [0, 0.055, -0.001] as const;
/** End of the curve, in the ribcage's frame, metres. */
export const WAIST_END = [0, -0.045, 0.003] as const;

/** Vertices around at full detail. */
const SEGMENTS = 40;
const EXPONENT = 2.3;
/** Height in the T-pose; sets the slope of the surface, hence its normals. */
const LENGTH = 0.18;
const WAIST: Station[] = [
  [0, 0.116, 0.116, 0.08, 0.08],
  [0.25, 0.11, 0.11, 0.078, 0.074],
  [0.5, 0.104, 0.104, 0.076, 0.07],
  [0.75, 0.104, 0.104, 0.078, 0.072],
  [1, 0.108, 0.108, 0.082, 0.078],
];

/** Slot of a ring. */
export function waistSlot(ring: number): Slot {
  return `waist_${ring}`;
}

/** Position of ring `ring` along the curve, 0–1. */
export function waistParameter(ring: number): number {
  return ring / (WAIST_RINGS - 1);
}

/** The tube at rest, ring after ring, upright along y from 0. */
function waistSurface(detail: number): Surface {
  const segments = atDetail(SEGMENTS, detail);
  const surface: Surface = { positions: [], indices: [] };
  for (let i = 0; i < WAIST_RINGS; i++) {
    const t = waistParameter(i);
    const [, uPlus, uMinus, wPlus, wMinus, u0, w0] = sectionAt(WAIST, t);
    for (let j = 0; j < segments; j++) {
      const [u, w] = superellipse((j / segments) * 2 * Math.PI, EXPONENT);
      surface.positions.push(u0 + u * (u > 0 ? uPlus : uMinus), t * LENGTH, w0 + w * (w > 0 ? wPlus : wMinus));
    }
  }
  const ring = (i: number, j: number) => i * segments + (j % segments);
  for (let i = 0; i + 1 < WAIST_RINGS; i++)
    for (let j = 0; j < segments; j++)
      surface.indices.push(
        ...[ring(i, j), ring(i + 1, j), ring(i, j + 1)],
        ...[ring(i, j + 1), ring(i + 1, j), ring(i + 1, j + 1)],
      );
  return surface;
}

/** Ring of a vertex of {@link waistSurface}. */
export function waistRingOf(vertex: number, detail: number): number {
  return Math.floor(vertex / atDetail(SEGMENTS, detail));
}

/** Height of ring `ring` in {@link waistSurface}; the ring's slot has its origin there. */
export function waistRestHeight(ring: number): number {
  return waistParameter(ring) * LENGTH;
}

/** The waist as one part; its slot is the first ring's, and the geometry distributes its vertices to the others. */
export function waistParts(detail: number): Part[] {
  return [{ slot: waistSlot(0), tone: "joint", surface: waistSurface(detail) }];
}
