/** All parts merged into one skinned geometry, built once and shared by every mannequin on the page. */

import { BufferAttribute, BufferGeometry } from "three";
import { vertexNormals } from "./loft";
import { bodyParts, type Tone } from "./parts";
import { slotIndex } from "./slots";
import { waistRestHeight, waistRingOf, waistSlot } from "./waist";

/** Order of the material groups. */
export const TONES: readonly Tone[] = ["shell", "joint"];

/**
 * Builds the geometry: positions and normals in each slot's own coordinates, the slot as the only bone of a vertex, and
 * one group a tone.
 */
export function buildGeometry(): BufferGeometry {
  const positions: number[] = [];
  const normals: number[] = [];
  const slots: number[] = [];
  const indices: number[] = [];
  const geometry = new BufferGeometry();
  const parts = bodyParts();
  for (const [group, tone] of TONES.entries()) {
    const start = indices.length;
    for (const { slot, surface } of parts.filter((part) => part.tone === tone)) {
      const first = positions.length / 3;
      const vertices = surface.positions.length / 3;
      const bends = slot === waistSlot(0);
      for (let vertex = 0; vertex < vertices; vertex++) {
        const ring = bends ? waistRingOf(vertex) : 0;
        const [x, y, z] = [0, 1, 2].map((axis) => surface.positions[3 * vertex + axis]!) as [number, number, number];
        positions.push(x, bends ? y - waistRestHeight(ring) : y, z);
        slots.push(slotIndex(bends ? waistSlot(ring) : slot), 0, 0, 0);
      }
      for (const component of vertexNormals(surface)) normals.push(component);
      for (const index of surface.indices) indices.push(first + index);
    }
    geometry.addGroup(start, indices.length - start, group);
  }
  const weights = new Uint8Array(slots.length);
  for (let vertex = 0; vertex < weights.length; vertex += 4) weights[vertex] = 1;
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  geometry.setAttribute("skinIndex", new BufferAttribute(new Uint8Array(slots), 4));
  geometry.setAttribute("skinWeight", new BufferAttribute(weights, 4));
  geometry.setIndex(new BufferAttribute(new Uint16Array(indices), 1));
  return geometry;
}

let shared: { geometry: BufferGeometry; users: number } | undefined;

/** The shared geometry; every call is to be matched by one of {@link releaseGeometry}. */
export function acquireGeometry(): BufferGeometry {
  shared ??= { geometry: buildGeometry(), users: 0 };
  shared.users++;
  return shared.geometry;
}

/** Gives the shared geometry back; the last user frees it. */
export function releaseGeometry(): void {
  if (shared && --shared.users === 0) {
    shared.geometry.dispose();
    shared = undefined;
  }
}
