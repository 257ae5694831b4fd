/**
 * The skeleton of a character in three.js: nodes of skins and their ancestors, in the pose in which the skin was
 * modelled (`shared/spec/embedding.md` section 5.1 and 5.2). Everything is measured in the space of the character's
 * object, whose own placement belongs to the page.
 */
import { Matrix4, type Object3D, Quaternion, type SkinnedMesh, Vector3 } from "three";
import type { Skeleton } from "../engine/character/rig";
import { StrutError } from "../engine/errors";

/** Maximum number of joints that the engine binds, as in `rust/strut-core/src/skeleton.rs`. */
export const MAX_JOINTS = 512;
/** Relative difference that is allowed between the scales along two axes, because exporters round. */
const EVEN = 0.01;
/** Share of a skin's size within which its joints agree on the skin's placement. */
const AGREEMENT = 1e-3;

/** Relative change of a bone's length since modelling that is ignored, because files round. */
const ELSEWHERE = 0.005;

/** Maximum number of candidate placements of a skin that are counted; files of real programs have one. */
const MAX_TRIED = 64;

/** The file's placement of the skin is used up to this ratio of its joint distance to that of the nearest candidate. */
const MUCH_NEARER = 2;

/**
 * A bone of a skin: its position in the character's object, and the transform from the skin's space to it in the skin's
 * bind pose.
 */
interface BoundBone {
  readonly bone: Object3D;
  readonly matrix: Matrix4;
  readonly inverse: Matrix4;
}

/** Maximum number of joints with which the candidates are compared. */
const MAX_SAMPLED = 256;

/** A skin, and the placement of its modelling space in the character's object. */
export interface Skin {
  readonly mesh: SkinnedMesh;
  readonly objectFromSkin: Matrix4;
}

/** The joints of a character. */
export interface Joints extends Skeleton {
  /** The node of each joint; the first is the character's object itself. */
  readonly nodes: readonly Object3D[];
  readonly skins: readonly Skin[];
  /** Scale of each joint's children, included in the offsets. */
  readonly scales: Float64Array;
  /** Whether the scale of each joint is the same along all axes, without mirroring. */
  readonly even: readonly boolean[];
  /** Position of each joint in the bind pose, in the character's object. */
  readonly places: readonly Vector3[];
  /** Whether the joints agree on the placement of the skins. */
  readonly isSure: boolean;
  /** Joints whose node has another parent, or another position below its parent, than the joint: poses translate them, too. */
  readonly moved: readonly number[];
  /** Joints whose node is not in the skin's bind pose. */
  readonly displaced: ReadonlySet<number>;
  /** Number of joints that were left out, as the engine binds at most 512. */
  readonly dropped: number;
}

/** Selects the joints of a character. */
export interface JointChoice {
  /** Nodes that are joints whether a skin uses them or not. */
  readonly chosen?: Iterable<Object3D>;
  /**
   * Whether it must have a skin. Without one, all nodes that display nothing are joints, with their current pose as the
   * rest pose.
   */
  readonly needsSkin?: boolean;
  /** Whether all nodes that display nothing are joints although there are skins; a leftover skin names few. */
  readonly all?: boolean;
  /** Rotation of skins whose joints do not agree on their placement. */
  readonly turn?: Matrix4;
  /** Nodes that are attached to other nodes than their parents. */
  readonly hung?: ReadonlyMap<Object3D, Object3D>;
  /** Nodes that poses do not move: they are bound where they are, not in the skin's bind pose. */
  readonly still?: ReadonlySet<Object3D>;
}

/** The joints of a character. @throws StrutError `bad-file` if it has no skin and needs one */
export function jointsOf(object: Object3D, choice: JointChoice = {}): Joints {
  const { needsSkin = true, all: takesAll = false, hung = new Map<Object3D, Object3D>(), still = new Set() } = choice;
  const chosen = [...(choice.chosen ?? [])];
  const matrices = matricesIn(object);
  const { skins, bindMatrices, isSure } = skinsOf(object, matrices, choice.turn);
  if (skins.length === 0 && needsSkin) {
    const message = "This model has no skin: no mesh follows its bones.";
    throw new StrutError({ code: "bad-file", message, hint: "Choose a rigged character." });
  }
  const kept = new Set<Object3D>();
  const bones = skins.length > 0 && !takesAll ? bindMatrices.keys() : [...matrices.keys()].filter(showsNothing);
  for (const node of [object, ...bones, ...bindMatrices.keys(), ...chosen])
    for (let above: Object3D | null = node; above && matrices.has(above); above = above.parent) kept.add(above);
  const all = kept.size;
  dropLeafChains(kept, matrices, new Set([...chosen, ...hung.keys(), ...hung.values()]));
  const nodes: Object3D[] = [];
  const parents: number[] = [];
  const collect = (node: Object3D, parent: number) => {
    const index = nodes.push(node) - 1;
    parents.push(parent);
    for (const child of node.children) if (kept.has(child) && !hung.has(child)) collect(child, index);
    for (const [child, above] of hung) if (above === node) collect(child, index);
  };
  collect(object, -1);

  const count = nodes.length;
  const [offsets, bind, local] = [
    new Float32Array(3 * count),
    new Float32Array(4 * count),
    new Float32Array(4 * count),
  ];
  const scales = new Float64Array(count);
  const even: boolean[] = [];
  const rotations: Quaternion[] = [];
  const places: Vector3[] = [];
  const moved: number[] = [];
  const displaced = new Set<number>();
  for (const [j, node] of nodes.entries()) {
    const above = parents[j]!;
    const own = sizeOf(matrices.get(node)!);
    scales[j] = own.mean;
    const modelled = still.has(node) ? undefined : bindMatrices.get(node);
    if (modelled && !near(modelled, matrices.get(node)!)) displaced.add(j);
    const bound = modelled ?? (hung.has(node) ? matrices.get(node) : undefined);
    const size = bound ? sizeOf(bound) : own;
    even.push(own.even && size.even);
    const rotation = new Quaternion();
    if (bound) rotation.setFromRotationMatrix(rigid(bound));
    else if (above >= 0) rotation.copy(rotations[above]!).multiply(node.quaternion).normalize();
    rotations.push(rotation);
    rotation.toArray(bind, 4 * j);
    if (above < 0) {
      local[3] = 1;
      places.push(new Vector3());
      continue;
    }
    // A playing mixer has left the nodes in the middle of a motion. If a skin contains their bind pose, it is used.
    const place = new Vector3();
    if (bound) {
      place.setFromMatrixPosition(bound);
      rotations[above]!.clone()
        .invert()
        .multiply(rotation)
        .toArray(local, 4 * j);
    } else {
      place.copy(node.position).multiplyScalar(scales[above]!).applyQuaternion(rotations[above]!).add(places[above]!);
      node.quaternion.toArray(local, 4 * j);
    }
    places.push(place);
    if (hung.has(node) || (bound && liesElsewhere(node, scales[above]!, place.distanceTo(places[above]!))))
      moved.push(j);
    place
      .clone()
      .sub(places[above]!)
      .toArray(offsets, 3 * j);
  }
  for (const numbers of [offsets, bind, local])
    if (!numbers.every(Number.isFinite)) {
      const message = "The joint positions of this model are out of range.";
      throw new StrutError({ code: "bad-file", message, hint: "Export it again." });
    }
  return {
    names: nodes.map(nameInFile),
    parents: Int32Array.from(parents),
    offsets,
    bind,
    local,
    nodes,
    skins,
    scales,
    even,
    places,
    isSure,
    moved,
    displaced,
    dropped: all - count,
  };
}

/** The name of a node in its file: loaders change names for three.js. */
export function nameInFile({ name, userData }: Object3D): string {
  // The loaders of glTF and of FBX store it in different properties.
  const kept: unknown = userData.name ?? userData.originalName;
  return typeof kept === "string" ? kept : name;
}

/** Whether a node's distance from its parent has changed since modelling. */
function liesElsewhere({ position }: Object3D, scale: number, modelled: number): boolean {
  return Math.abs(position.length() * scale - modelled) > ELSEWHERE * Math.max(modelled, position.length() * scale);
}

/** Whether a node is neither drawn nor a light nor a camera. */
function showsNothing(node: Object3D): boolean {
  return !("geometry" in node || "isLight" in node || "isCamera" in node);
}

/** The matrix of every node in the space of the object. */
function matricesIn(object: Object3D): Map<Object3D, Matrix4> {
  const matrices = new Map<Object3D, Matrix4>([[object, new Matrix4()]]);
  // A map can grow during iteration: parents come before their children.
  for (const [node, matrix] of matrices)
    for (const child of node.children) {
      const local = new Matrix4().compose(child.position, child.quaternion, child.scale);
      matrices.set(child, local.premultiply(matrix));
    }
  return matrices;
}

/** The skins, and the position of each of their joints when they were modelled. */
function skinsOf(object: Object3D, matrices: ReadonlyMap<Object3D, Matrix4>, turn: Matrix4 | undefined) {
  const skins: Skin[] = [];
  let isSure = true;
  const bindMatrices = new Map<Object3D, Matrix4>();
  object.traverse((node) => {
    const mesh = node as SkinnedMesh;
    if (!mesh.isSkinnedMesh || !mesh.skeleton) return;
    const { bones, boneInverses } = mesh.skeleton;
    const present = bones.flatMap((bone, i) => {
      const [matrix, inverse] = [bone && matrices.get(bone), boneInverses[i]];
      return matrix && inverse && inverse.determinant() !== 0 ? [{ bone: bone!, matrix, inverse }] : [];
    });
    if (present.length === 0) return;
    // The file's own space, the mesh's space, and the space of the skeleton's parent.
    const own = new Set<Object3D>(bones);
    const roots = new Set(bones.flatMap((bone) => (bone?.parent && !own.has(bone.parent) ? [bone.parent] : [])));
    const places = [mesh, ...roots].slice(0, MAX_TRIED).flatMap((node) => matrices.get(node) ?? []);
    const found = agreed(present, [new Matrix4(), ...places]);
    isSure &&= found.isSure;
    const objectFromSkin = turn && !found.isSure ? found.place.clone().premultiply(turn) : found.place;
    skins.push({ mesh, objectFromSkin });
    for (const { bone, inverse } of present)
      if (!bindMatrices.has(bone)) bindMatrices.set(bone, inverse.clone().invert().premultiply(objectFromSkin));
  });
  return { skins, bindMatrices, isSure };
}

/**
 * Every joint that is still in the bind pose gives the same placement of its skin: the matrix on which most joints
 * agree. So a file that was saved in another pose is still bound in the skin's bind pose.
 *
 * If fewer than half agree, as in a file that was saved in the middle of a motion, the agreeing ones may be the fingers
 * of one hand. Then the matrix is chosen that brings the joints nearest to their current positions: one of those that
 * files use (`ofFile`), unless another one is much nearer.
 */
function agreed(present: readonly BoundBone[], ofFile: readonly Matrix4[]): { place: Matrix4; isSure: boolean } {
  const matrices = present.map(({ matrix, inverse }) => matrix.clone().multiply(inverse));
  let [best, most] = [matrices[0]!, 0];
  const tried: Matrix4[] = [];
  for (const matrix of matrices) {
    if (tried.length === MAX_TRIED) break;
    if (tried.some((other) => near(other, matrix))) continue;
    tried.push(matrix);
    const votes = matrices.filter((other) => near(matrix, other)).length;
    if (votes > most) [best, most] = [matrix, votes];
  }
  if (2 * most >= matrices.length) return { place: best, isSure: true };
  const scale = sizeOf(best).mean;
  const joints = sampled(present);
  const nearest = (places: readonly Matrix4[]) => {
    const found = places.map((place) => ({ place, distance: distanceOf(joints, place) }));
    return found.reduce((a, b) => (b.distance < a.distance ? b : a));
  };
  const [own, any] = [nearest(ofFile.map((place) => resized(place, scale))), nearest(tried)];
  return { place: own.distance <= MUCH_NEARER * any.distance ? own.place : any.place, isSure: false };
}

/** A matrix with another scale: the scale of the bones' own matrices gives the skin's unit. */
function resized(matrix: Matrix4, scale: number): Matrix4 {
  const position = new Vector3().setFromMatrixPosition(matrix);
  return rigid(matrix)
    .scale(new Vector3(scale, scale, scale))
    .setPosition(position);
}

/** Joints of a skin, where they were modelled and where they are now; a few hundred are enough. */
function sampled(present: readonly BoundBone[]): { modelled: Vector3; lies: Vector3 }[] {
  const step = Math.ceil(present.length / MAX_SAMPLED);
  return present
    .filter((_, i) => i % step === 0)
    .map(({ matrix, inverse }) => ({
      modelled: new Vector3().setFromMatrixPosition(inverse.clone().invert()),
      lies: new Vector3().setFromMatrixPosition(matrix),
    }));
}

/** Sum of the distances between the joints' positions and their modelled positions under a placement of the skin. */
function distanceOf(joints: ReturnType<typeof sampled>, objectFromSkin: Matrix4): number {
  const place = new Vector3();
  return joints.reduce(
    (sum, { modelled, lies }) => sum + place.copy(modelled).applyMatrix4(objectFromSkin).distanceTo(lies),
    0,
  );
}

function near(a: Matrix4, b: Matrix4): boolean {
  const size = Math.max(...a.elements.map(Math.abs));
  return a.elements.every((value, i) => Math.abs(value - b.elements[i]!) <= AGREEMENT * size);
}

/** Mean scale of a matrix, and whether it is the same along all axes without mirroring. */
function sizeOf(matrix: Matrix4): { mean: number; even: boolean } {
  const [x, y, z] = [new Vector3(), new Vector3(), new Vector3()];
  matrix.extractBasis(x, y, z);
  const lengths = [x.length(), y.length(), z.length()];
  const mean = (lengths[0]! + lengths[1]! + lengths[2]!) / 3;
  const spread = Math.max(...lengths) - Math.min(...lengths);
  // Rotated children of unevenly scaled joints are sheared.
  const shear = Math.max(Math.abs(x.dot(y)), Math.abs(y.dot(z)), Math.abs(z.dot(x)));
  const even = mean > 0 && spread <= EVEN * mean && shear <= EVEN * mean * mean && matrix.determinant() > 0;
  return { mean, even };
}

/** The rotation of a matrix, as a matrix. */
function rigid(matrix: Matrix4): Matrix4 {
  return new Matrix4().extractRotation(matrix);
}

/**
 * Removes leaf chains of the tree, the shortest first, until the engine can bind the rest: hair, faces and skirts are
 * many short chains, and limbs are long ones.
 */
function dropLeafChains(
  kept: Set<Object3D>,
  matrices: ReadonlyMap<Object3D, Matrix4>,
  chosen: ReadonlySet<Object3D>,
): void {
  const position = (node: Object3D) => new Vector3().setFromMatrixPosition(matrices.get(node)!);
  while (kept.size > MAX_JOINTS) {
    const below = new Map<Object3D, number>();
    for (const { parent } of kept) if (parent) below.set(parent, (below.get(parent) ?? 0) + 1);
    const chains: { nodes: Object3D[]; length: number }[] = [];
    for (const leaf of kept) {
      if (below.has(leaf)) continue;
      const nodes: Object3D[] = [];
      let length = 0;
      for (let node = leaf; node.parent && kept.has(node.parent) && !chosen.has(node); node = node.parent) {
        nodes.push(node);
        length += position(node).distanceTo(position(node.parent));
        if (below.get(node.parent)! > 1) break;
      }
      if (nodes.length > 0) chains.push({ nodes, length });
    }
    if (chains.length === 0) return;
    chains.sort((a, b) => a.length - b.length);
    // As many chains as are in excess, but at most half: afterwards the tree has other leaves.
    for (const { nodes } of chains.slice(0, Math.ceil(chains.length / 2))) {
      if (kept.size <= MAX_JOINTS) return;
      for (const node of nodes) kept.delete(node);
    }
  }
}
