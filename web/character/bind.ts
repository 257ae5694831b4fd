/** Binds a character of three.js to the engine: the roles of its joints, its unit and its soles. */
import { type AnimationClip, Matrix4, type Object3D, Quaternion, type SkinnedMesh, Vector3 } from "three";
import { CharacterRig, likelyRoles, looseFeet } from "../engine/character/rig";
import { type CharacterGlue, characterPackage } from "../engine/character/wasm";
import { StrutError } from "../engine/errors";
import { JOINT, JOINTS, ROLES, type Role } from "../humanoid";
import { type JointChoice, type Joints, jointsOf, MAX_JOINTS, nameInFile } from "./joints";
import { JointsError } from "./joints_error";
import { MovedJoints } from "./moved";
import { type SkinSoles, soles } from "./sole";
import type { BindOptions, GltfLike, Origin, VrmLike } from "./types";
import { type GltfJson, isRecord, vrmBone, vrmRoles } from "./vrm_humanoid";

/**
 * Largest difference between the soles' height measured on the mesh and the guessed one, as a share of the leg. Beyond
 * it the mesh's feet are ignored.
 */
const FARTHEST_SOLE = 0.6;

/** Joints that are at the same height in a symmetric pose. */
const LEVEL = [
  [JOINT.left_upper_leg, JOINT.right_upper_leg],
  [JOINT.left_foot, JOINT.right_foot],
] as const;
/** From the smaller angle on, a body leans; from the larger one on, it lies; radians. */
const [LEAST_LEAN, MOST_LEAN] = [0.01, 0.7];

/** Roles that a skeleton must have, as in `rust/strut-core/src/retarget/binding.rs`. */
const REQUIRED = ROLES.filter((role) => !/shoulder|toes|chest|neck|head/.test(role));

/** A bound character, without its licence and its exports. */
export interface Bound {
  readonly rig: CharacterRig;
  readonly joints: Joints;
  /** Joint of each role; −1 for a role without a joint. */
  readonly roles: Int32Array;
  /** Joints that poses rotate: joints of roles, and joints between them. */
  readonly driven: Int32Array;
  /** The driven joints that are also translated. */
  readonly moved: MovedJoints;
  /** Units of the hips' parent per unit of the skeleton. */
  readonly hipsScale: number;
  readonly notes: readonly string[];
  readonly warnings: readonly string[];
}

/** The origin of a caller's object: an object of three.js, a glTF or a VRM. */
export function originOf(root: Object3D | VrmLike | GltfLike): Origin {
  if ("isObject3D" in root) {
    const object = withBones(root);
    return {
      object,
      json: undefined,
      vrm: undefined,
      clips: [...new Set([root, object])].flatMap(clipsOf),
      ...NO_FILE,
    };
  }
  if ("humanoid" in root) return { object: root.scene, json: undefined, vrm: root, clips: [], ...NO_FILE };
  const { json, associations } = root.parser;
  const nodes = new Map<number, Object3D>();
  for (const [object, place] of associations)
    if (place?.nodes !== undefined && isObject(object) && !nodes.has(place.nodes)) nodes.set(place.nodes, object);
  return {
    object: root.scene,
    json: isRecord(json) ? (json as GltfJson) : undefined,
    vrm: root.userData?.vrm as VrmLike | undefined,
    clips: root.animations ?? [],
    nodeOf: (index) => nodes.get(index),
    indexOf: (node) => associations.get(node)?.nodes,
  };
}

/** The object itself, or for a skin alone the object that holds it and its bones. */
function withBones(object: Object3D): Object3D {
  const { isSkinnedMesh, skeleton } = object as Partial<SkinnedMesh>;
  const bones = isSkinnedMesh ? (skeleton?.bones.filter(Boolean) ?? []) : [];
  const holds = (node: Object3D) => bones.every((bone) => isBelow(bone, node));
  for (let node: Object3D | null = object; node; node = node.parent) if (holds(node)) return node;
  return object;
}

function isBelow(node: Object3D, above: Object3D): boolean {
  for (let at: Object3D | null = node; at; at = at.parent) if (at === above) return true;
  return false;
}

const clipsOf = ({ animations }: Object3D): readonly AnimationClip[] => animations;

const NO_FILE = { nodeOf: () => undefined, indexOf: () => undefined };

const isObject = (value: unknown): value is Object3D => isRecord(value) && value.isObject3D === true;

/**
 * Binds a character.
 * @throws StrutError `bad-file` with what the model lacks, `bad-input` if an option does not fit it, `load`
 */
export async function bind(origin: Origin, options?: BindOptions): Promise<Bound> {
  return boundWith(await characterPackage.load(), origin, options);
}

/**
 * Binds a character with the engine's package, which must be loaded.
 * @param needsSkin whether a skeleton without a skin is refused
 * @throws StrutError `bad-file` with what the model lacks, `bad-input` if an option does not fit it
 */
export function boundWith(glue: CharacterGlue, origin: Origin, options: BindOptions = {}, needsSkin = true): Bound {
  const given = givenRoles(origin, options.roles ?? {});
  const choice = { chosen: new Set(given.values()), needsSkin };
  const { metresPerUnit = 1 } = options;
  const takeWith = (more: JointChoice): { joints: Joints; rig: CharacterRig } => {
    const joints = hungRight(glue, origin.object, { ...choice, ...more });
    return { joints, rig: rigOf(glue, joints, knownRoles(joints, given), metresPerUnit) };
  };
  const take = (all: boolean): { joints: Joints; rig: CharacterRig } => {
    let found = takeWith({ all });
    const turn = found.joints.isSure ? undefined : upright(found.joints, found.rig);
    const turned = turn ? { all, turn } : { all };
    if (turn) {
      found.rig.dispose();
      found = takeWith(turned);
    }
    const above = aboveHips(found.joints, found.rig.roles);
    if (!above.some((joint) => found.joints.displaced.has(joint))) return found;
    found.rig.dispose();
    return takeWith({ ...turned, still: new Set(above.map((joint) => found.joints.nodes[joint]!)) });
  };
  let taken: ReturnType<typeof take>;
  try {
    taken = take(false);
  } catch (thrown) {
    // A leftover skin, such as that of the hands, may name few joints of many.
    if (!(thrown instanceof JointsError) || !needsSkin || thrown.joints.length >= nodesOf(origin.object)) throw thrown;
    try {
      taken = take(true);
    } catch {
      throw thrown;
    }
  }
  const { joints, rig } = taken;
  try {
    const { roles } = rig;
    checkScales(joints, roles);
    const measured = soles(joints, roles, rig.worldFromFile);
    const warnings = [...(origin.notes ?? [])];
    if (options.soleHeight !== undefined) rig.setSole(options.soleHeight, measured?.points);
    else if (!measured) warnings.push("No mesh follows the feet; the height of the soles was guessed.");
    else if (!isPlausible(rig, measured)) {
      rig.setSole(undefined);
      warnings.push("The mesh of the feet does not end where soles can be; their height was guessed.");
    }
    const left =
      joints.dropped > 0
        ? [
            `${joints.dropped === 1 ? "1 joint of hair, face or clothes was" : `${joints.dropped} joints of hair, face or clothes were`} left out.`,
          ]
        : [];
    const notes = [...rig.notes, ...left, ...warnings];
    const hipsParent = joints.parents[roles[JOINT.hips]!]!;
    const hipsScale = hipsParent < 0 ? 1 : 1 / joints.scales[hipsParent]!;
    const driven = drivenJoints(joints, roles);
    return { rig, joints, roles, driven, moved: new MovedJoints(joints, roles, driven), hipsScale, notes, warnings };
  } catch (thrown) {
    rig.dispose();
    throw thrown;
  }
}

/** Number of nodes of an object that could be joints. */
function nodesOf(object: Object3D): number {
  let nodes = 0;
  object.traverse((node) => {
    if (!("geometry" in node)) nodes++;
  });
  return Math.min(nodes, MAX_JOINTS);
}

/** The joints of a character. Feet that are children of the root are attached to their legs. */
function hungRight(glue: CharacterGlue, object: Object3D, choice: JointChoice): Joints {
  const joints = jointsOf(object, choice);
  const hung = new Map(looseFeet(glue, joints).map(({ foot, leg }) => [joints.nodes[foot]!, joints.nodes[leg]!]));
  return hung.size > 0 ? jointsOf(object, { ...choice, hung }) : joints;
}

/**
 * The rotation that straightens a body leaning to one side. It is needed if its file was saved in the middle of a
 * motion and does not contain the bind pose: in that pose left and right are at the same height. `undefined` if the
 * body does not lean.
 */
function upright({ places }: Joints, { roles, worldFromFile }: CharacterRig): Matrix4 | undefined {
  const toOurs = new Quaternion().fromArray(worldFromFile);
  const across = new Vector3();
  for (const [left, right] of LEVEL) across.add(places[roles[left]!]!).sub(places[roles[right]!]!);
  across.applyQuaternion(toOurs);
  const lean = Math.atan2(across.y, Math.hypot(across.x, across.z));
  if (!(Math.abs(lean) > LEAST_LEAN && Math.abs(lean) < MOST_LEAN)) return undefined;
  const level = new Vector3(across.x, 0, across.z).normalize();
  const turn = new Quaternion().setFromUnitVectors(across.normalize(), level);
  return new Matrix4().makeRotationFromQuaternion(toOurs.clone().invert().multiply(turn).multiply(toOurs));
}

/** The joints above the hips, which poses do not move: a file that was saved in the middle of a motion displaces them. */
function aboveHips({ parents }: Joints, roles: Int32Array): number[] {
  const above: number[] = [];
  for (let joint = parents[roles[JOINT.hips]!]!; joint >= 0; joint = parents[joint]!) above.push(joint);
  return above;
}

/** Joint of each known role; −1 for the others. */
function knownRoles({ nodes }: Joints, given: ReadonlyMap<Role, Object3D>): Int32Array {
  return Int32Array.from(ROLES, (role) => {
    const node = given.get(role);
    return node ? nodes.indexOf(node) : -1;
  });
}

/** Binds joints. @throws JointsError with the existing joints and all roles without a joint */
function rigOf(glue: CharacterGlue, joints: Joints, known: Int32Array, metresPerUnit: number): CharacterRig {
  try {
    return new CharacterRig(glue, joints, known, metresPerUnit);
  } catch (thrown) {
    if (!(thrown instanceof StrutError) || thrown.code !== "bad-file") throw thrown;
    const likely = likelyRoles(glue, joints, known);
    const missing = REQUIRED.filter((role) => likely[JOINT[role]]! < 0);
    // Hips and spine are found between the limbs.
    const limbs = missing.filter((role) => role !== "hips" && role !== "spine");
    const names = joints.names.map((name, joint) => name || `(joint ${joint})`);
    const found = ROLES.flatMap((role, i) => (likely[i]! >= 0 ? [[role, names[likely[i]!]!]] : []));
    const { code, message, hint } = thrown;
    const roles = Object.fromEntries(found) as JointsError["roles"];
    throw new JointsError({ code, message, hint, missing: limbs.length > 0 ? limbs : missing, joints: names, roles });
  }
}

/** The nodes of known roles: chosen by the caller, otherwise from the VRM. */
function givenRoles({ object, json, vrm, nodeOf }: Origin, chosen: BindOptions["roles"]): Map<Role, Object3D> {
  const nodes = new Map<Role, Object3D>();
  if (vrm) {
    for (const role of ROLES) {
      const upper = role === "chest" ? vrm.humanoid.getRawBoneNode("upperChest") : null;
      const node = upper ?? vrm.humanoid.getRawBoneNode(vrmBone(role));
      if (node) nodes.set(role, node);
    }
  } else if (json) {
    for (const [role, index] of Object.entries(vrmRoles(json) ?? {})) {
      const node = nodeOf(index);
      if (node) nodes.set(role as Role, node);
    }
  }
  for (const [role, name] of Object.entries(chosen ?? {}) as [Role, string][]) {
    if (!ROLES.includes(role)) throw badChoice(`There is no role '${role}'.`);
    const node = named(object, name);
    if (!node) throw badChoice(`This model has no joint '${name}'.`);
    nodes.set(role, node);
  }
  return nodes;
}

function named(object: Object3D, name: string): Object3D | undefined {
  let found: Object3D | undefined;
  object.traverse((node) => {
    if (!found && (nameInFile(node) === name || node.name === name)) found = node;
  });
  return found;
}

function badChoice(message: string): StrutError {
  return new StrutError({
    code: "bad-input",
    message,
    hint: "Map each role to the name of a joint: { hips: 'Hips' }.",
  });
}

/** @throws StrutError `bad-file` if a joint of a role, or one above it, has different scales along its axes */
function checkScales(joints: Joints, roles: Int32Array): void {
  for (const role of roles)
    for (let joint = role; joint >= 0; joint = joints.parents[joint]!) {
      if (joints.even[joint]) continue;
      const name = joints.names[joint] ? `Joint '${joints.names[joint]}'` : "A joint without a name";
      const message = `${name} is scaled differently along its axes.`;
      const hint = "Apply the scale in the program that made the model, and export it again.";
      throw new StrutError({ code: "bad-file", message, hint });
    }
}

/**
 * Sets soles that are plausible for this body; a robe's hem is not a sole. Returns whether they are plausible;
 * otherwise they are to be discarded.
 */
function isPlausible(rig: CharacterRig, { height, points }: SkinSoles): boolean {
  const guessed = rig.proportions;
  rig.setSole(height, points);
  const leg = -(guessed[3 * JOINT.left_lower_leg + 1]! + guessed[3 * JOINT.left_foot + 1]!);
  return Math.abs(rig.proportions[1]! - guessed[1]!) < FARTHEST_SOLE * leg;
}

/** The joints that poses rotate, ascending: joints of roles, and joints between them. */
function drivenJoints({ parents }: Joints, roles: Int32Array): Int32Array {
  const ofRoles = new Set(roles.filter((joint) => joint >= 0));
  const driven = new Set(ofRoles);
  for (const role of ofRoles) {
    const between: number[] = [];
    let joint = parents[role]!;
    for (; joint >= 0 && !ofRoles.has(joint); joint = parents[joint]!) between.push(joint);
    // Joints above the hips are not between two roles.
    if (joint >= 0) for (const each of between) driven.add(each);
  }
  return Int32Array.from(driven).sort();
}

/** Names of the joints of roles, as in the file. */
export function roleNames({ joints, roles }: Bound): Partial<Record<Role, string>> {
  const named = ROLES.flatMap((role, i) => (roles[i]! >= 0 ? [[role, joints.names[roles[i]!]!]] : []));
  return Object.fromEntries(named.slice(0, JOINTS)) as Partial<Record<Role, string>>;
}
