/** The help dialog: the keys, and a switch for single-character shortcuts. */

import { button, Toggle } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import type { SingleKeys } from "./single_keys";

const list = (rows: readonly (readonly [string, string])[]) =>
  html("dl", {}, ...rows.flatMap(([keys, does]) => [html("dt", {}, keys), html("dd", {}, does)]));

export class Help {
  readonly element: HTMLDialogElement;

  constructor(singleKeys: SingleKeys) {
    const letters = new Toggle(strings.play.help.singleKeys, (on) => {
      singleKeys.on = on;
      letters.on = on;
    });
    letters.on = singleKeys.on;
    const close = button(strings.play.help.close, () => this.element.close(), { icon: "close", class: "plain" });
    this.element = html(
      "dialog",
      { class: "help", closedby: "any", "aria-labelledby": "help-heading" },
      html("div", { class: "section-heading" }, html("h2", { id: "help-heading" }, strings.play.help.heading), close),
      list(strings.play.help.keys),
      letters.element,
      html("h3", {}, strings.play.help.polygonHeading),
      list(strings.play.help.polygon),
      html("h3", {}, strings.play.help.atlasHeading),
      list(strings.play.help.atlas),
      html("h3", {}, strings.play.help.crowdHeading),
      list(strings.play.help.crowd),
      html("p", { class: "caption" }, strings.play.help.drop),
      html(
        "p",
        { class: "caption" },
        html("a", { href: "docs/index.html" }, strings.play.help.manual),
        " · ",
        html("a", { href: "notices.txt" }, strings.play.help.notices),
      ),
    );
  }

  open(): void {
    if (!this.element.open) this.element.showModal();
  }
}
