/** Asks what to do with a database whose name is in use. */

import { button } from "../../../ui/controls/buttons";
import { html } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { askInDialog, dialogActions } from "../../ui/dialog";
import type { SavedDatabase } from "./saved_databases";

const words = strings.data.replace;

/** `undefined` if the dialog was cancelled. */
export function askToReplace(present: SavedDatabase): Promise<"replace" | "keep both" | undefined> {
  const { name, styles, clips } = present;
  return askInDialog("replace", words.heading(name), (choose, cancel) => [
    html("p", {}, words.what(strings.data.heading(clips, styles.length))),
    dialogActions(
      button(strings.data.cancel, cancel, { label: true }),
      button(words.replace, () => choose("replace"), { label: true, class: "outlined" }),
      button(words.keepBoth, () => choose("keep both"), { label: true, class: "outlined" }),
    ),
  ]);
}
