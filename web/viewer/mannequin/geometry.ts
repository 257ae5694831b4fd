/** All parts merged into one geometry, built once a level of detail and shared by every mannequin on the page. */

import { BufferAttribute, BufferGeometry } from "three";
import { vertexNormals } from "./loft";
import type { Tone } from "./part";
import { bodyParts } from "./parts";
import { slotIndex } from "./slots";
import { waistRestHeight, waistRingOf, waistSlot } from "./waist";

/** Order of the material groups. */
export const TONES: readonly Tone[] = ["shell", "joint"];

/**
 * Builds the geometry: positions and normals in each slot's own coordinates, the slot of every vertex, and one group a
 * tone. `detail` scales the number of vertices along and around every part; 1 is full detail.
 */
export function buildGeometry(detail = 1): BufferGeometry {
  const positions: number[] = [];
  const normals: number[] = [];
  const slots: number[] = [];
  const indices: number[] = [];
  const geometry = new BufferGeometry();
  const parts = bodyParts(detail);
  for (const [group, tone] of TONES.entries()) {
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
    }
    geometry.addGroup(start, indices.length - start, group);
  }
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  geometry.setAttribute("slot", new BufferAttribute(new Uint8Array(slots), 1));
  geometry.setIndex(new BufferAttribute(new Uint16Array(indices), 1));
  return geometry;
}

const shared = new Map<number, { geometry: BufferGeometry; users: number }>();

/** The shared geometry of a level of detail; every call is to be matched by one of {@link releaseGeometry}. */
export function acquireGeometry(detail: number): BufferGeometry {
  const entry = shared.get(detail) ?? { geometry: buildGeometry(detail), users: 0 };
  shared.set(detail, entry);
  entry.users++;
  return entry.geometry;
}

/** Gives a shared geometry back; the last user frees it. */
export function releaseGeometry(detail: number): void {
  const entry = shared.get(detail);
  if (!entry || --entry.users > 0) return;
  entry.geometry.dispose();
  shared.delete(detail);
}
