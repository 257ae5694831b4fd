/** Measures as a language writes them. */
import type { Measure } from "../../../element/figure/kind";
import { type Language, WORDS } from "../../../element/figure/languages";
import { figure } from "../../../element/figure/words/words";
import type { Said } from "../../../lessons/text/text";

/** Decimals of numbers in sentences. */
const DIGITS = 2;

/** Numbers with the language's decimal sign, styles and joints by their names. */
export function saidIn(language: Language, measure: Measure): Said {
  const words = WORDS[language];
  const names: Readonly<Record<string, string>> = { ...words.joints, ...words.inputs, ...words.styles };
  const say = (value: number | string) =>
    typeof value === "number" ? figure(value, DIGITS, words) : Object.hasOwn(names, value) ? names[value]! : value;
  return Object.fromEntries(Object.entries(measure).map(([name, value]) => [name, say(value)]));
}
