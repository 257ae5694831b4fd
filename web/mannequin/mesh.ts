/** All parts merged into one mesh, in plain arrays. */

import { vertexNormals } from "./loft";
import type { Part, Tone } from "./part";
import { partGroups } from "./parts";
import { slotIndex } from "./slots";
import { waistRestHeight, waistRingOf, waistSlot } from "./waist";

/** Order of the groups of a mesh. */
export const TONES: readonly Tone[] = ["shell", "joint"];

/** An indexed triangle mesh in which every vertex follows one slot. */
export interface MannequinMesh {
  /** xyz of every vertex in its slot's own coordinates, metres. */
  positions: Float32Array;
  /** Unit normal xyz of every vertex, in the same coordinates. */
  normals: Float32Array;
  /** Slot of every vertex, see `SLOTS`. */
  slots: Uint8Array;
  /** Three vertices per triangle, counter-clockwise from outside. */
  indices: Uint16Array;
  /** The range of indices of every tone, in the order of {@link TONES}. */
  groups: { start: number; count: number }[];
}

/**
 * Builds the mesh in steps of a few milliseconds, so that a page is not blocked.
 *
 * @param detail - Factor on the number of vertices along and around every part, above 0; 1 is full detail.
 */
export function* meshSteps(detail: number): Generator<undefined, MannequinMesh> {
  const positions: number[] = [];
  const normals: number[] = [];
  const slots: number[] = [];
  const indices: number[] = [];
  const parts: Part[] = [];
  for (const group of partGroups(detail)) {
    parts.push(...group);
    yield;
  }
  const groups: MannequinMesh["groups"] = [];
  for (const tone of TONES) {
    const start = indices.length;
    for (const { slot, surface } of parts.filter((part) => part.tone === tone)) {
      const first = positions.length / 3;
      const vertices = surface.positions.length / 3;
      const bends = slot === waistSlot(0);
      for (let vertex = 0; vertex < vertices; vertex++) {
        const ring = bends ? waistRingOf(vertex, detail) : 0;
        const [x, y, z] = [0, 1, 2].map((axis) => surface.positions[3 * vertex + axis]!) as [number, number, number];
        positions.push(x, bends ? y - waistRestHeight(ring) : y, z);
        slots.push(slotIndex(bends ? waistSlot(ring) : slot));
      }
      for (const component of vertexNormals(surface)) normals.push(component);
      for (const index of surface.indices) indices.push(first + index);
      yield;
    }
    groups.push({ start, count: indices.length - start });
  }
  return {
    positions: new Float32Array(positions),
    normals: new Float32Array(normals),
    slots: new Uint8Array(slots),
    indices: new Uint16Array(indices),
    groups,
  };
}

/** Builds the mesh at once; see {@link meshSteps}. */
export function buildMesh(detail = 1): MannequinMesh {
  const steps = meshSteps(detail);
  for (;;) {
    const { done, value } = steps.next();
    if (done) return value;
  }
}
