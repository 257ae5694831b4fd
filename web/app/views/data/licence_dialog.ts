/** Shows the licence of a public data set before any of it is downloaded. */

import { button } from "../../../ui/controls/buttons";
import { html } from "../../../ui/dom";
import { megabytes } from "../../strings/numerals";
import { strings } from "../../strings/strings";
import { askInDialog, dialogActions } from "../../ui/dialog";
import { capitalised } from "../../ui/words";
import type { PublicSet } from "./catalogue";

const words = strings.data.sets;

/** Whether the licence was accepted. */
export async function askToFetch(set: PublicSet): Promise<boolean> {
  const { name, about, licence, citation, page, bytes, base } = set;
  const link = (href: string, text: string) => html("a", { href, target: "_blank", rel: "noreferrer" }, text);
  const { host } = new URL(base);
  const agreed = await askInDialog<true>("licence", name, (choose, cancel) => [
    html("p", {}, words.about(capitalised(about))),
    html("p", {}, words.licence, link(licence.url, licence.name), words.licenceNote(licence.note)),
    html("p", { class: "caption" }, `${words.cite(citation)} `, link(page, words.more)),
    html("p", { class: "caption" }, bytes > 0 ? words.fromSized(host, megabytes(bytes)) : words.from(host)),
    dialogActions(
      button(strings.data.cancel, cancel, { label: true }),
      button(words.download, () => choose(true), { label: true, class: "outlined" }),
    ),
  ]);
  return agreed ?? false;
}
