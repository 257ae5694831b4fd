/** The mannequin's mesh for three.js, built once a level of detail and shared by every mannequin on the page. */

import { BufferAttribute, BufferGeometry } from "three";
import { buildMesh } from "../../mannequin/mesh";

/** Builds the geometry of a level of detail: attributes `position`, `normal` and `slot`, and one group a tone. */
function buildGeometry(detail: number): BufferGeometry {
  const { positions, normals, slots, indices, groups } = buildMesh(detail);
  const geometry = new BufferGeometry();
  for (const [material, { start, count }] of groups.entries()) geometry.addGroup(start, count, material);
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  geometry.setAttribute("slot", new BufferAttribute(slots, 1));
  geometry.setIndex(new BufferAttribute(indices, 1));
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
