/** The styles of a batch: each is a folder of the zip, with the name that `strut stylize-batch` gives it. */
import type { StylizeOptions } from "../../client/protocol";
import { engineOptions } from "../../link/engine_options";
import type { PlayState } from "../../link/play";

/** A style of a batch, with the options of all its files. */
export interface Variant {
  /** The argument of `--style`, with `+` instead of commas. */
  name: string;
  options: StylizeOptions;
}

/** Resets the options that concern one clip only: its labels, and styles at its frames. */
const OF_ALL = { action: "", inputStyle: "", track: [] };

/** The current styles of Play, rounded to thousandths so that their name specifies them completely. */
export function presentVariant(state: PlayState, neutral: string): Variant {
  const { styles, parts, ...options } = engineOptions(state, neutral);
  const rounded = (weights: Readonly<Record<string, number>>) =>
    Object.fromEntries(Object.entries(weights).map(([style, weight]) => [style, Math.round(1000 * weight) / 1000]));
  const whole = rounded(styles);
  const partsOf = Object.entries(parts).map(([part, weights]) => [part, rounded(weights ?? {})] as const);
  const name = [nameOf(whole, neutral), ...partsOf.map(([part, weights]) => `${part}-${nameOf(weights, neutral)}`)];
  return {
    name: name.join(" ").replaceAll("_", "-"),
    options: { ...options, ...OF_ALL, styles: whole, parts: Object.fromEntries(partsOf) },
  };
}

/** Each style alone at full weight, with the current model options of Play. */
export function singleVariants(state: PlayState, neutral: string, styles: readonly string[]): Variant[] {
  const options = engineOptions({ ...state, parts: {} }, neutral);
  return styles.map((style) => ({
    name: style,
    options: { ...options, ...OF_ALL, styles: style === neutral ? {} : { [style]: 1 } },
  }));
}

/** `proud`, or `proud=0.62+old=0.12`. */
function nameOf(weights: Readonly<Record<string, number>>, neutral: string): string {
  const entries = Object.entries(weights).filter(([, weight]) => weight !== 0);
  if (entries.length === 0) return neutral;
  const [style, weight] = entries[0]!;
  if (entries.length === 1 && weight === 1) return style;
  return entries.map(([name, share]) => `${name}=${share}`).join("+");
}
