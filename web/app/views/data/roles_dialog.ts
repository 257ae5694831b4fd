/** The table of roles: which joint of a skeleton is which part of the body, to be corrected by hand. */

import type { Roles } from "../../../client/build/protocol";
import { ROLES } from "../../../humanoid";
import { button } from "../../../ui/controls/buttons";
import { html } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { spoken } from "../../ui/words";
import type { KnownSkeleton } from "./corpus";
import { askInDialog, dialogActions } from "./dialog";

const words = strings.data.roles;
/** What a role's list says where no joint has the role. */
const NO_JOINT = -1;

/** Asks for the roles of a skeleton; undefined where nothing was to be changed. */
export function askForRoles(skeleton: KnownSkeleton): Promise<Roles | undefined> {
  const roles = skeleton.chosen ?? skeleton.roles;
  const selects = ROLES.map((role, i) => {
    const select = html("select", { "aria-label": spoken(role) }, html("option", { value: NO_JOINT }, words.none));
    for (const [joint, name] of skeleton.joints.entries()) select.append(html("option", { value: joint }, name));
    select.value = String(roles[i] ?? NO_JOINT);
    return select;
  });
  const rows = ROLES.map((role, i) =>
    html("label", { class: "role" }, html("span", {}, spoken(role)), html("span", { class: "select" }, selects[i]!)),
  );
  return askInDialog<Roles>("roles", words.heading, (choose, cancel) => {
    const use = () => choose(Int32Array.from(selects, (select) => Number(select.value)));
    return [
      html("p", { class: "caption" }, skeleton.fault || skeleton.note),
      html("div", { class: "role-table" }, ...rows),
      dialogActions(
        button(strings.data.cancel, cancel, { label: true }),
        button(words.use, use, { label: true, class: "outlined" }),
      ),
    ];
  });
}
