/** Formats measurements in a language. */
import type { Measure } from "../../../figures/kind";
import { type Language, WORDS } from "../../../figures/languages";
import { formatNumber } from "../../../figures/words/words";
import type { Said } from "../../../lessons/text/text";

/** Decimals of numbers in sentences. */
const DIGITS = 2;

/**
 * Numbers with the language's decimal sign, styles and joints by their names.
 * @param decimals number of decimals by name, where it is not two
 */
export function saidIn(language: Language, measure: Measure, decimals: Readonly<Record<string, number>> = {}): Said {
  const words = WORDS[language];
  const names: Readonly<Record<string, string>> = { ...words.joints, ...words.inputs, ...words.styles };
  const say = (name: string, value: number | string) =>
    typeof value === "number"
      ? formatNumber(value, decimals[name] ?? DIGITS, words)
      : Object.hasOwn(names, value)
        ? names[value]!
        : value;
  return Object.fromEntries(Object.entries(measure).map(([name, value]) => [name, say(name, value)]));
}
