/** The columns of the Compare view: the input, a method, the real counterpart, or one of the two settings. Pure. */
import { type StyleWeights, type StylizeOptions, TRAINED_METHODS } from "../../worker/protocol";
import { fromHash, type PlayState } from "../state";
import { strings } from "../strings/strings";
import { engineOptions } from "../style_settings";

/** What a column may show, as the URL names it. */
export const COLUMN_NAMES = ["input", "mar", "lar", "knn", "nn", ...TRAINED_METHODS, "real", "a", "b"] as const;
export type ColumnName = (typeof COLUMN_NAMES)[number];

/** Fewest and most columns. */
export const LEAST_COLUMNS = 1;
export const MOST_COLUMNS = 5;

/** What a column shows, in a line. */
export function columnCaption(column: ColumnName, input: string, { k }: PlayState): string {
  const { captions } = strings.compare;
  switch (column) {
    case "input":
      return captions.input(input);
    case "mar":
    case "lar":
    case "knn":
      return captions[column](k);
    case "a":
    case "b":
      return captions.setting;
    default:
      return captions[column];
  }
}

/** Whether what a column shows is known to all engines. */
export function isTrained(column: ColumnName): boolean {
  return TRAINED_METHODS.some((method) => method === column);
}

/** What the engine is asked for in a column; `undefined` for the input and its counterpart, which are not styled. */
export function columnOptions(column: ColumnName, state: PlayState, neutral: string): StylizeOptions | undefined {
  if (column === "input" || column === "real") return undefined;
  if (column !== "a" && column !== "b") return { ...engineOptions(state, neutral), method: column };
  if (state.side === column || state.other === "") return engineOptions(state, neutral);
  return engineOptions(fromHash(state.other), neutral);
}

/** Whose performance the whole motion would be compared with; `undefined` where the style changes over body or time. */
export function counterpartStyles(state: PlayState, neutral: string): StyleWeights | undefined {
  const { styles, parts, track } = engineOptions(state, neutral);
  return track.length === 0 && Object.keys(parts).length === 0 ? styles : undefined;
}
