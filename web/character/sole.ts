/** Positions of a character's soles, measured on the meshes of its feet (`shared/spec/embedding.md` 5.4). */
import {
  type BufferAttribute,
  type InterleavedBufferAttribute,
  Matrix4,
  type Object3D,
  Quaternion,
  type SkinnedMesh,
  Vector3,
} from "three";
import { JOINT } from "../humanoid";
import type { Joints } from "./joints";

/** Minimum weight with which a vertex belongs to a joint. */
const OWN = 0.5;

/** Directions in which the outermost vertices of a foot are searched: all over the sphere, about 8° apart. */
const DIRECTIONS = Array.from({ length: 700 }, (_, i) => {
  const [y, turn] = [1 - (2 * i + 1) / 700, i * Math.PI * (3 - Math.sqrt(5))];
  const radius = Math.sqrt(1 - y * y);
  return new Vector3(radius * Math.cos(turn), y, radius * Math.sin(turn));
});

/** The soles of a character in the bind pose, in the unit of the joints. */
export interface SkinSoles {
  /** Height of the lowest vertex of the feet along the body's up axis. */
  readonly height: number;
  /**
   * Vertices that can touch the ground first when a foot rotates, five numbers each: side (0 left), part (0 foot, 1
   * toes), and position relative to the joint of that part, xyz along the axes of the file.
   */
  readonly points: Float32Array;
}

/**
 * The soles; `undefined` if no skin follows the feet.
 * @param roles joint of each role, −1 for a role without a joint
 * @param worldFromFile rotation from the axes of the file to Strut's, xyzw
 */
export function soles(joints: Joints, roles: Int32Array, worldFromFile: ArrayLike<number>): SkinSoles | undefined {
  const toOurs = new Quaternion().fromArray(worldFromFile);
  const up = new Vector3(0, 1, 0).applyQuaternion(toOurs.clone().invert());
  let height = Infinity;
  const points: number[] = [];
  for (const [side, feet] of [
    [JOINT.left_foot, JOINT.left_toes],
    [JOINT.right_foot, JOINT.right_toes],
  ].entries()) {
    const [foot, toes] = feet.map((role) => roles[role]!) as [number, number];
    const ofToes = descendants(joints, toes);
    const ofFoot = new Set([...descendants(joints, foot)].filter((joint) => !ofToes.has(joint)));
    for (const [part, { joint, members }] of [
      { joint: foot, members: ofFoot },
      { joint: toes, members: ofToes },
    ].entries()) {
      if (joint < 0) continue;
      const found = outermost(joints, joint, members, DIRECTIONS);
      for (const { x, y, z } of found) points.push(side, part, x, y, z);
      for (const point of found) height = Math.min(height, up.dot(joints.places[joint]!) + up.dot(point));
    }
  }
  return Number.isFinite(height) ? { height, points: Float32Array.from(points) } : undefined;
}

/** A joint and all its descendants. */
function descendants({ parents }: Joints, joint: number): Set<number> {
  const found = new Set(joint < 0 ? [] : [joint]);
  for (const [other, parent] of parents.entries()) if (found.has(parent)) found.add(other);
  return found;
}

/** The vertices of some joints that lie farthest in each direction, relative to a joint in the bind pose. */
function outermost(
  joints: Joints,
  joint: number,
  members: ReadonlySet<number>,
  directions: readonly Vector3[],
): Vector3[] {
  const nodes = new Set([...members].map((member) => joints.nodes[member]!));
  const farthest = directions.map(() => ({ distance: -Infinity, point: new Vector3() }));
  const origin = joints.places[joint]!;
  const take = (point: Vector3) => {
    for (const [i, direction] of directions.entries()) {
      const distance = direction.dot(point);
      if (distance <= farthest[i]!.distance) continue;
      farthest[i]!.distance = distance;
      farthest[i]!.point.copy(point);
    }
  };
  const point = new Vector3();
  for (const { mesh, objectFromSkin } of joints.skins) {
    const { position, skinIndex, skinWeight } = mesh.geometry.attributes;
    const isMember = mesh.skeleton.bones.map((bone) => bone !== undefined && nodes.has(bone));
    if (!position || !skinIndex || !skinWeight || !isMember.includes(true)) continue;
    const matrix = new Matrix4().multiplyMatrices(objectFromSkin, mesh.bindMatrix);
    for (let v = 0; v < position.count; v++) {
      let weight = 0;
      for (let k = 0; k < 4; k++) if (isMember[skinIndex.getComponent(v, k)]) weight += skinWeight.getComponent(v, k);
      if (weight >= OWN) take(point.fromBufferAttribute(position, v).applyMatrix4(matrix).sub(origin));
    }
  }
  for (const member of members)
    for (const { position, matrix } of hardParts(joints, member))
      for (let v = 0; v < position.count; v++)
        take(point.fromBufferAttribute(position, v).applyMatrix4(matrix).sub(origin));
  const found = farthest.filter(({ distance }) => distance > -Infinity).map((each) => each.point);
  return found.filter((a, i) => found.findIndex((b) => a.equals(b)) === i);
}

/**
 * Meshes without a skin that are children of a joint, such as the feet of a robot, and the positions of their vertices
 * in the bind pose.
 */
function hardParts(joints: Joints, joint: number) {
  const parts: { position: BufferAttribute | InterleavedBufferAttribute; matrix: Matrix4 }[] = [];
  const isJoint = new Set<Object3D>(joints.nodes);
  const scale = joints.scales[joint]!;
  const rotation = new Quaternion().fromArray(joints.bind, 4 * joint);
  const walk = (node: Object3D, above: Matrix4) => {
    for (const child of node.children) {
      if (isJoint.has(child)) continue;
      const matrix = new Matrix4().compose(child.position, child.quaternion, child.scale).premultiply(above);
      const { isMesh, isSkinnedMesh, geometry } = child as Partial<SkinnedMesh>;
      const position = isMesh && !isSkinnedMesh ? geometry?.attributes.position : undefined;
      if (position) parts.push({ position, matrix });
      walk(child, matrix);
    }
  };
  walk(joints.nodes[joint]!, new Matrix4().compose(joints.places[joint]!, rotation, new Vector3(scale, scale, scale)));
  return parts;
}
