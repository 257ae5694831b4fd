/** The table of roles: which joint of a skeleton is which part of the body, to be corrected by hand. */
import { ROLES } from "../../viewer";
import type { Roles } from "../../worker/build/protocol";
import { button } from "../controls/buttons";
import { html } from "../dom";
import { strings } from "../strings/strings";
import { spoken } from "../words";
import type { KnownSkeleton } from "./corpus";

const words = strings.data.roles;

/** Asks for the roles of a skeleton; resolves to those chosen, or undefined where nothing was to be changed. */
export function askForRoles(skeleton: KnownSkeleton): Promise<Roles | undefined> {
  const roles = skeleton.chosen ?? skeleton.roles;
  const selects = ROLES.map((role, i) => {
    const select = html("select", { "aria-label": spoken(role) }, html("option", { value: -1 }, words.none));
    for (const [joint, name] of skeleton.joints.entries()) select.append(html("option", { value: joint }, name));
    select.value = String(roles[i] ?? -1);
    return select;
  });
  const rows = ROLES.map((role, i) =>
    html("label", { class: "role" }, html("span", {}, spoken(role)), html("span", { class: "select" }, selects[i]!)),
  );
  return new Promise((resolve) => {
    let chosen: Roles | undefined;
    const done = button(
      words.use,
      () => {
        chosen = Int32Array.from(selects, (select) => Number(select.value));
        dialog.close();
      },
      { label: true, class: "outlined" },
    );
    const cancel = button(strings.data.cancel, () => dialog.close(), { label: true });
    const dialog = html(
      "dialog",
      { class: "help roles", "aria-labelledby": "roles-heading" },
      html("h2", { id: "roles-heading" }, words.heading),
      html("p", { class: "caption" }, skeleton.fault || skeleton.note),
      html("div", { class: "role-table" }, ...rows),
      html("div", { class: "dialog-actions" }, cancel, done),
    );
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(chosen);
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
