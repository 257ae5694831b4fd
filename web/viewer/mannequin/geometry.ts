/** The mannequin's mesh for three.js, built once per level of detail and shared by all mannequins on the page. */

import { BufferAttribute, BufferGeometry } from "three";
import { buildMesh, type MannequinMesh, meshSteps } from "../../mannequin/mesh";

/** The geometry of a mesh: attributes `position`, `normal` and `slot`, and one group per tone. */
function geometryOf({ positions, normals, slots, indices, groups }: MannequinMesh): BufferGeometry {
  const geometry = new BufferGeometry();
  for (const [material, { start, count }] of groups.entries()) geometry.addGroup(start, count, material);
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  geometry.setAttribute("slot", new BufferAttribute(slots, 1));
  geometry.setIndex(new BufferAttribute(indices, 1));
  return geometry;
}

const shared = new Map<number, { geometry: BufferGeometry; users: number }>();

/** The shared geometry of a level of detail. Every call must be matched by a call of {@link releaseGeometry}. */
export function acquireGeometry(detail: number): BufferGeometry {
  return share(detail, () => buildMesh(detail));
}

/** Builds the shared geometry of a level of detail in steps of a few milliseconds, and acquires it. */
export function* prepareGeometry(detail: number): Generator<undefined> {
  const mesh = yield* meshSteps(detail);
  share(detail, () => mesh);
}

function share(detail: number, build: () => MannequinMesh): BufferGeometry {
  const entry = shared.get(detail) ?? { geometry: geometryOf(build()), users: 0 };
  shared.set(detail, entry);
  entry.users++;
  return entry.geometry;
}

/** Releases a shared geometry; the last release frees it. */
export function releaseGeometry(detail: number): void {
  const entry = shared.get(detail);
  if (!entry || --entry.users > 0) return;
  entry.geometry.dispose();
  shared.delete(detail);
}
