/** The style sheets of the player, created once and shared by all of them. */

import base from "../ui/controls/base.css?inline";
import buttons from "../ui/controls/button.css?inline";
import slider from "../ui/controls/slider.css?inline";
import polygon from "../ui/polygon/polygon.css?inline";
import tokens from "../ui/tokens.css?inline";
import player from "./player.css?inline";

/** Tokens that a page may set, as `--strut-…`. */
const OWN_COLOURS = ["signal", "input", "weight", "ink", "panel"] as const;

/** The tokens, overridden by the page's own; forced colours of the user take precedence. */
function overridable(text: string): string {
  const end = text.indexOf("@media");
  const declared = new RegExp(`--(${OWN_COLOURS.join("|")}): ([^;]+);`, "g");
  const stage = /--stage-(inner|outer): ([^;]+);/g;
  return (
    text
      .slice(0, end)
      .replace(declared, "--$1: var(--strut-$1, $2);")
      .replace(stage, "--stage-$1: var(--strut-stage, $2);") + text.slice(end)
  );
}

let made: CSSStyleSheet[] | undefined;

/** The sheets. */
export function sheets(): CSSStyleSheet[] {
  made ??= [overridable(tokens), base, buttons, slider, polygon, player].map((text) => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(text);
    return sheet;
  });
  return made;
}
