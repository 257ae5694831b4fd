/** Credits of the character in use, over the stage. */
import type { Licence } from "../character/licence";
import { html } from "../ui/dom";
import { strings } from "./strings";

export class Credit {
  readonly element = html("p", { class: "credit", part: "credit", hidden: true });

  /** Shows the names that a licence requires; hidden if there are none. */
  show(licence: Licence | undefined): void {
    const { title = "", authors = [], url, credit = false } = licence ?? {};
    const text = authors.length > 0 ? strings.credit(title, authors) : title;
    this.element.hidden = !credit || text === "";
    const isWeb = url !== undefined && /^https?:/.test(url);
    this.element.replaceChildren(isWeb ? html("a", { href: url, target: "_blank", rel: "noreferrer" }, text) : text);
  }
}
