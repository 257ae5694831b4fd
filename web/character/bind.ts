/** A character of three.js bound to the engine: the roles of its joints, its unit and its soles. */
import type { Object3D } from "three";
import { CharacterRig } from "../engine/character/rig";
import { type CharacterGlue, characterPackage } from "../engine/character/wasm";
import { StrutError } from "../engine/errors";
import { JOINT, JOINTS, ROLES, type Role } from "../humanoid";
import { type Joints, jointsOf, nameInFile } from "./joints";
import { soles } from "./sole";
import type { BindOptions, GltfLike, Origin, VrmLike } from "./types";
import { type GltfJson, isRecord, vrmBone, vrmRoles } from "./vrm_humanoid";

/** Metres between the soles' heights of a file and a guess beyond which a mesh's feet are not believed, as a share of the leg. */
const FARTHEST_SOLE = 0.6;

/** A bound character, without what its file allows and what can be made of it. */
export interface Bound {
  readonly rig: CharacterRig;
  readonly joints: Joints;
  /** Joint of each role; −1 where there is none. */
  readonly roles: Int32Array;
  /** Joints that poses turn: those of roles, and those between spine and chest. */
  readonly driven: Int32Array;
  /** Units of the hips' parent per unit of the skeleton. */
  readonly hipsScale: number;
  readonly notes: readonly string[];
}

/** What a caller gave: an object of three.js, a glTF or a VRM. */
export function originOf(root: Object3D | VrmLike | GltfLike): Origin {
  if ("isObject3D" in root)
    return { object: root, json: undefined, vrm: undefined, clips: root.animations, ...NO_FILE };
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

const NO_FILE = { nodeOf: () => undefined, indexOf: () => undefined };

const isObject = (value: unknown): value is Object3D => isRecord(value) && value.isObject3D === true;

/**
 * Binds a character.
 * @throws StrutError `bad-file` with what the model lacks, `bad-input` where an option does not fit it, `load`
 */
export async function bind(origin: Origin, options?: BindOptions): Promise<Bound> {
  return boundWith(await characterPackage.load(), origin, options);
}

/**
 * Binds a character with the engine's package, which is loaded.
 * @param needsSkin whether a skeleton without a skin is refused
 * @throws StrutError `bad-file` with what the model lacks, `bad-input` where an option does not fit it
 */
export function boundWith(glue: CharacterGlue, origin: Origin, options: BindOptions = {}, needsSkin = true): Bound {
  const given = givenRoles(origin, options.roles ?? {});
  const joints = jointsOf(origin.object, [...given.values()], needsSkin);
  const known = Int32Array.from(ROLES, (role) => {
    const node = given.get(role);
    return node ? joints.nodes.indexOf(node) : -1;
  });
  const { metresPerUnit = 1 } = options;
  const rig = new CharacterRig(glue, joints, known, metresPerUnit);
  try {
    const { roles } = rig;
    checkScales(joints, roles);
    const measured = soles(joints, roles, rig.worldFromFile);
    const sole = options.soleHeight ?? measured?.height;
    const notes = [...rig.notes];
    if (sole !== undefined && (options.soleHeight !== undefined || isPlausible(rig, sole, metresPerUnit)))
      rig.setSole(sole, measured?.points);
    else notes.push("No skin follows the feet; the height of the soles was guessed.");
    if (joints.dropped > 0) notes.push(`${joints.dropped} joints of hair, face or clothes were left out.`);
    const hipsParent = joints.parents[roles[JOINT.hips]!]!;
    const hipsScale = hipsParent < 0 ? 1 : 1 / joints.scales[hipsParent]!;
    return { rig, joints, roles, driven: drivenJoints(joints, roles), hipsScale, notes };
  } catch (thrown) {
    rig.dispose();
    throw thrown;
  }
}

/** The nodes of roles that are known: by the caller's choice, else as the VRM says. */
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
    hint: "Roles are given by the names of joints: { hips: 'Hips' }.",
  });
}

/** @throws StrutError `bad-file` where a joint of a role, or one above it, is scaled differently along its axes */
function checkScales(joints: Joints, roles: Int32Array): void {
  for (const role of roles)
    for (let joint = role; joint >= 0; joint = joints.parents[joint]!) {
      if (joints.even[joint]) continue;
      const message = `Joint '${joints.names[joint]}' is scaled differently along its axes.`;
      const hint = "Apply the scale in the program that made the model, and export it again.";
      throw new StrutError({ code: "bad-file", message, hint });
    }
}

/** Whether feet that end so low can be the feet of this body: a robe's hem is no sole. */
function isPlausible(rig: CharacterRig, sole: number, metresPerUnit: number): boolean {
  const guessed = rig.proportions;
  rig.setSole(sole);
  const measured = rig.proportions;
  const leg = -(guessed[3 * JOINT.left_lower_leg + 1]! + guessed[3 * JOINT.left_foot + 1]!);
  return Number.isFinite(metresPerUnit) && Math.abs(measured[1]! - guessed[1]!) < FARTHEST_SOLE * leg;
}

/** The joints that poses turn, ascending. */
function drivenJoints({ parents }: Joints, roles: Int32Array): Int32Array {
  const driven = new Set(roles.filter((joint) => joint >= 0));
  const [spine, chest] = [roles[JOINT.spine]!, roles[JOINT.chest]!];
  for (let joint = chest; joint >= 0 && joint !== spine; joint = parents[joint]!) driven.add(joint);
  return Int32Array.from(driven).sort();
}

/** Names of the joints of roles, as in the file. */
export function roleNames({ joints, roles }: Bound): Partial<Record<Role, string>> {
  const named = ROLES.flatMap((role, i) => (roles[i]! >= 0 ? [[role, joints.names[roles[i]!]!]] : []));
  return Object.fromEntries(named.slice(0, JOINTS)) as Partial<Record<Role, string>>;
}
