/** The style sheets of figures, created once and shared by all of them. */
import base from "../ui/controls/base.css?inline";
import buttons from "../ui/controls/button.css?inline";
import knob from "../ui/controls/knob.css?inline";
import segment from "../ui/controls/segment.css?inline";
import select from "../ui/controls/select.css?inline";
import slider from "../ui/controls/slider.css?inline";
import toggle from "../ui/controls/toggle.css?inline";
import tokens from "../ui/tokens.css?inline";
import figure from "./figure.css?inline";

const SHARED = [tokens, base, buttons, knob, segment, select, slider, toggle, figure];

const made = new Map<string, CSSStyleSheet>();

/** The sheets of all figures, and that of a kind. */
export function figureSheets(kind?: string): CSSStyleSheet[] {
  return (kind ? [...SHARED, kind] : SHARED).map(sheetOf);
}

function sheetOf(text: string): CSSStyleSheet {
  const known = made.get(text);
  if (known) return known;
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(text);
  made.set(text, sheet);
  return sheet;
}
