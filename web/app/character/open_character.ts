/** Opens files of characters, and asks the user for missing decisions. Loaded with the first character. */

import { JointsError } from "../../character/joints_error";
import type { Licence } from "../../character/licence";
import { type LoadCharacterOptions, loadCharacter, loadMotions } from "../../character/load";
import { mostWalking } from "../../character/most_walking";
import { bytesOf } from "../../character/read";
import type { Character, CharacterMotion } from "../../character/types";
import type { DroppedFile } from "../../client/build/protocol";
import type { CallOptions } from "../../client/protocol";
import { ROLES, type Role } from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import { askInDialog, dialogActions } from "../ui/dialog";
import { askForRoles } from "../ui/roles_dialog";
import { spoken } from "../ui/words";

const words = strings.page.characters;

/** Joint of each role, by name, if the user set it. */
export type ChosenRoles = Partial<Record<Role, string>>;

/**
 * Opens a character. The user is asked for permission to perform it if the author does not allow everyone to.
 * @param roles the user's mapping of its joints
 * @param accepted whether this user has accepted its terms before
 * @throws StrutError as `loadCharacter`
 */
export function openCharacter(
  file: File,
  call: CallOptions,
  roles?: ChosenRoles,
  accepted = roles !== undefined,
): Promise<Character> {
  const options: LoadCharacterOptions = { accept: accepted ? () => true : askToPerform, ...(roles && { roles }) };
  return loadCharacter(file, { ...call, ...options }, () => import("@pixiv/three-vrm"));
}

/** Contents of a file. */
export interface Content {
  readonly character: Character | undefined;
  /** Its motions as BVH files. */
  readonly motions: readonly { name: string; bytes: ArrayBuffer }[];
}

/** A `.gltf` and the files that it names as one `.glb`; other files unchanged. @throws StrutError `bad-file` */
export async function asOneFile(file: File, beside: readonly DroppedFile[]): Promise<File> {
  if (!/\.gltf$/i.test(file.name)) return file;
  const glb = await bytesOf(beside.length > 0 ? beside.map((each) => each.file) : [file], undefined);
  return new File([glb], file.name.replace(/\.gltf$/i, ".glb"));
}

/**
 * Opens a file that may contain a character, motions, or both.
 * @throws StrutError as `loadCharacter`, if it contains neither
 */
export async function openModel(file: File, call: CallOptions): Promise<Content> {
  if (/\.vrma$/i.test(file.name)) return { character: undefined, motions: asBvh(file, await loadMotions(file, call)) };
  try {
    const character = await openCharacter(file, call).catch((thrown: unknown) => openAsChosen(file, call, thrown));
    return { character, motions: asBvh(file, character.motions) };
  } catch (thrown) {
    if ((thrown as { code?: unknown }).code !== "bad-file") throw thrown;
    // A skeleton without a skin cannot perform, but may have motions.
    const motions = await loadMotions(file, call).catch(() => []);
    if (motions.length === 0) throw thrown;
    return { character: undefined, motions: asBvh(file, motions) };
  }
}

/**
 * Asks the user to map joints that cannot be identified, until the character can be bound.
 * @throws `reason` if there is no list of joints, or the user cancels
 */
async function openAsChosen(file: File, call: CallOptions, reason: unknown): Promise<Character> {
  for (let fault = reason; ; ) {
    // An object without limbs is not a misread body.
    if (!(fault instanceof JointsError) || Object.keys(fault.roles).length === 0) throw fault;
    const chosen = await askForJoints({
      joints: fault.joints,
      roles: fault.roles,
      notes: [fault.message, words.missing(fault.missing.map(spoken))],
    });
    if (!chosen) throw fault;
    try {
      return await openCharacter(file, call, chosen);
    } catch (thrown) {
      fault = thrown;
    }
  }
}

/** Motions as files that the engine opens, named after theirs; the one that walks most comes first. */
function asBvh(file: File, motions: readonly CharacterMotion[]): Content["motions"] {
  const title = file.name.replace(/\.[^.]*$/, "");
  const first = mostWalking(motions);
  const sorted = [...motions.slice(first, first + 1), ...motions.filter((_, i) => i !== first)];
  return sorted.map((motion) => ({
    name: motions.length > 1 ? `${title}, ${motion.name}` : title,
    bytes: new TextEncoder().encode(motion.toBVH()).buffer,
  }));
}

/** Asks the user to map the joints; `undefined` if nothing changes. */
export async function askForJoints({
  joints,
  roles,
  notes,
}: Pick<Character, "joints" | "roles" | "notes">): Promise<ChosenRoles | undefined> {
  const given = ROLES.map((role) => joints.indexOf(roles[role] ?? ""));
  const chosen = await askForRoles({ joints, roles: given, note: notes.filter(Boolean).join(" ") });
  if (!chosen) return undefined;
  return Object.fromEntries(ROLES.flatMap((role, i) => (chosen[i]! >= 0 ? [[role, joints[chosen[i]!]!]] : [])));
}

/** Asks whether the user has permission to perform a character that not everyone may perform. */
async function askToPerform({ title, url }: Licence): Promise<boolean> {
  const terms = url ? [html("a", { href: url, target: "_blank", rel: "noreferrer" }, words.read)] : [];
  const agreed = await askInDialog<true>("licence", words.notForAll, (choose, cancel) => [
    html("p", {}, words.terms(title || words.untitled), ...terms),
    dialogActions(
      button(strings.page.progress.cancel, cancel, { label: true }),
      button(words.allowed, () => choose(true), { label: true, class: "outlined" }),
    ),
  ]);
  return agreed ?? false;
}
