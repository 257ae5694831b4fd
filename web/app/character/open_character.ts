/** Opens files of characters, and asks what their files leave open. Loaded with the first character. */

import type { Licence } from "../../character/licence";
import { type LoadCharacterOptions, loadCharacter } from "../../character/load";
import type { Character } from "../../character/types";
import type { CallOptions } from "../../client/protocol";
import { ROLES, type Role } from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import { askInDialog, dialogActions } from "../ui/dialog";
import { askForRoles } from "../ui/roles_dialog";

const words = strings.page.characters;

/** Joint of each role, by name, where a person said so. */
export type ChosenRoles = Partial<Record<Role, string>>;

/**
 * Opens a character. A person is asked whether they may perform it where the author does not allow everybody to.
 * @param roles what a person said of its joints, who has accepted its terms before
 * @throws StrutError as `loadCharacter`
 */
export function openCharacter(file: File, call: CallOptions, roles?: ChosenRoles): Promise<Character> {
  const options: LoadCharacterOptions = roles ? { roles, accept: () => true } : { accept: askToPerform };
  return loadCharacter(file, { ...call, ...options }, () => import("@pixiv/three-vrm"));
}

/** Asks which joint is which; undefined where all stay as they are. */
export async function askForJoints({ joints, roles, notes }: Character): Promise<ChosenRoles | undefined> {
  const given = ROLES.map((role) => joints.indexOf(roles[role] ?? ""));
  const chosen = await askForRoles({ joints, roles: given, note: notes.join(" ") });
  if (!chosen) return undefined;
  return Object.fromEntries(ROLES.flatMap((role, i) => (chosen[i]! >= 0 ? [[role, joints[chosen[i]!]!]] : [])));
}

/** Asks whether the person may perform a character that not everybody may. */
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
