/** VRM's names of the roles, and the humanoid that a VRM's extensions declare. */
import { StrutError } from "../engine/errors";
import { ROLES, type Role } from "../humanoid";

/** VRM's bone of a role: `left_upper_arm` is `leftUpperArm`. */
export const vrmBone = (role: Role): string => role.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase());

/** The part of a glTF document that is read; none of it can be trusted. */
export interface GltfJson {
  readonly extensionsUsed?: unknown;
  readonly extensions?: Readonly<Record<string, unknown>>;
  readonly asset?: { readonly copyright?: unknown };
}

/** The extension of VRM 1 or of VRM 0 in a document. */
export function vrmOf(json: GltfJson): { version: 0 | 1; extension: Record<string, unknown> } | undefined {
  for (const [name, version] of [["VRMC_vrm", 1] as const, ["VRM", 0] as const]) {
    const extension = json.extensions?.[name];
    if (isRecord(extension)) return { version, extension };
  }
  return undefined;
}

/** The extension of a VRM Animation, which lists its bones as VRM 1 does. */
export function vrmaOf(json: GltfJson): Record<string, unknown> | undefined {
  const extension = json.extensions?.VRMC_vrm_animation;
  return isRecord(extension) ? extension : undefined;
}

/** Whether a value is an object with properties. */
export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/**
 * Index of the node of each role, as declared by a VRM or a VRM Animation; `undefined` for other files. The chest of
 * Strut carries neck and shoulders: it is `upperChest` if there is one.
 * @throws StrutError `bad-file` if the humanoid is missing, or names a bone twice
 */
export function vrmRoles(json: GltfJson): Partial<Record<Role, number>> | undefined {
  const vrm = vrmOf(json);
  const extension = vrm?.extension ?? vrmaOf(json);
  if (!extension) return undefined;
  const humanoid = isRecord(extension.humanoid) ? extension.humanoid : {};
  const nodes = new Map<string, number>();
  for (const [bone, node] of vrm?.version === 0 ? bonesOf0(humanoid) : bonesOf1(humanoid)) {
    if (nodes.has(bone)) throw broken(`This VRM names two joints as its ${bone}.`);
    nodes.set(bone, node);
  }
  if (nodes.size === 0) throw broken("This VRM has no humanoid: it does not say which of its joints are bones.");
  const roles: Partial<Record<Role, number>> = {};
  for (const role of ROLES) {
    const upper = role === "chest" ? nodes.get("upperChest") : undefined;
    const node = upper ?? nodes.get(vrmBone(role));
    if (node !== undefined) roles[role] = node;
  }
  return roles;
}

function* bonesOf1({ humanBones }: Record<string, unknown>): Generator<[string, number]> {
  if (!isRecord(humanBones)) return;
  for (const [bone, entry] of Object.entries(humanBones))
    if (isRecord(entry) && typeof entry.node === "number") yield [bone, entry.node];
}

function* bonesOf0({ humanBones }: Record<string, unknown>): Generator<[string, number]> {
  if (!Array.isArray(humanBones)) return;
  for (const entry of humanBones as unknown[]) {
    if (!isRecord(entry)) continue;
    const { bone, node } = entry;
    if (typeof bone === "string" && typeof node === "number" && node >= 0) yield [bone, node];
  }
}

function broken(message: string): StrutError {
  const hint = "Export it again from the program that made it.";
  return new StrutError({ code: "bad-file", message, hint });
}
