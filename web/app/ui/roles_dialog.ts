/** The joint mapping dialog: the joint of each body part, to be corrected by hand. */

import type { JointNames } from "../../client/protocol";
import { ROLES } from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import { askInDialog, dialogActions } from "./dialog";
import { spoken } from "./words";

const words = strings.page.roles;
/** Value of a role's list without a joint. */
const NO_JOINT = -1;

/** A skeleton whose roles the user sets. */
interface RoleQuestion {
  /** Names of its joints. */
  joints: readonly string[];
  /** Current joint of each role; −1 for none. */
  roles: ArrayLike<number>;
  /** A sentence on what was matched, or what is missing. */
  note: string;
}

/** Joints by role, from the index of the joint of each. */
export function jointNames(chosen: Int32Array, joints: readonly string[]): JointNames {
  return Object.fromEntries(ROLES.map((role, i) => [role, joints[chosen[i] ?? -1] ?? null]));
}

/** Asks for the roles of a skeleton: the joint of each, −1 for none; `undefined` if the user cancels. */
export function askForRoles({ joints, roles, note }: RoleQuestion): Promise<Int32Array | undefined> {
  const selects = ROLES.map((role, i) => {
    const select = html("select", { "aria-label": spoken(role) }, html("option", { value: NO_JOINT }, words.none));
    for (const [joint, name] of joints.entries()) select.append(html("option", { value: joint }, name));
    select.value = String(roles[i] ?? NO_JOINT);
    return select;
  });
  const rows = ROLES.map((role, i) =>
    html("label", { class: "role" }, html("span", {}, spoken(role)), html("span", { class: "select" }, selects[i]!)),
  );
  return askInDialog<Int32Array>("roles", words.heading, (choose, cancel) => {
    const use = () => choose(Int32Array.from(selects, (select) => Number(select.value)));
    return [
      html("p", { class: "caption" }, note),
      html("div", { class: "role-table" }, ...rows),
      dialogActions(
        button(strings.page.progress.cancel, cancel, { label: true }),
        button(words.use, use, { label: true, class: "outlined" }),
      ),
    ];
  });
}
