/** The columns of the Compare view: the input, a method, the real counterpart, or one of the two settings. Pure functions. */
import { type StyleWeights, type StylizeOptions, TRAINED_METHODS } from "../../../client/protocol";
import { engineOptions } from "../../../link/engine_options";
import { type AppState, fromHash } from "../../state/state";

import { strings } from "../../strings/strings";

/** Contents of a column, as named in the URL. */
export const COLUMN_NAMES = ["input", "mar", "lar", "knn", "nn", ...TRAINED_METHODS, "real", "a", "b"] as const;
export type ColumnName = (typeof COLUMN_NAMES)[number];

/** Fewest columns. */
export const MIN_COLUMNS = 1;

/**
 * Indices of the columns in the order of display. On a narrow screen, which shows one or two at once, the method of Strut is
 * the first.
 */
export function shownOrder(names: readonly ColumnName[], narrow: boolean): number[] {
  const order = names.map((_, i) => i);
  const strut = names.indexOf("mar");
  return narrow && strut > 0 ? [strut, ...order.filter((i) => i !== strut)] : order;
}

/** The contents of a column in one line. */
export function columnCaption(column: ColumnName, input: string, { k }: AppState): string {
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

/** Whether a column's method is trained beforehand: only the Compare view's own engine has it. */
export function isTrained(column: ColumnName): boolean {
  return TRAINED_METHODS.some((method) => method === column);
}

/** The engine's options for a column; `undefined` for the input and its counterpart, which are not styled. */
export function columnOptions(column: ColumnName, state: AppState, neutral: string): StylizeOptions | undefined {
  if (column === "input" || column === "real") return undefined;
  if (column !== "a" && column !== "b") return { ...engineOptions(state, neutral), method: column };
  if (state.side === column || state.other === "") return engineOptions(state, neutral);
  return engineOptions(fromHash(state.other), neutral);
}

/** The request for a column's motion. Requests with equal keys give equal motions. */
export type MotionRequest = { column: ColumnName; key: string } & (
  | { kind: "style"; options: StylizeOptions }
  | { kind: "counterpart"; styles: StyleWeights | undefined }
);

/** The request for a column's motion; `undefined` for the input, which needs none. */
export function motionRequest(column: ColumnName, state: AppState, neutral: string): MotionRequest | undefined {
  if (column === "real") {
    const styles = counterpartStyles(state, neutral);
    return { column, key: `real ${JSON.stringify(styles)}`, kind: "counterpart", styles };
  }
  const options = columnOptions(column, state, neutral);
  return options && { column, key: JSON.stringify(options), kind: "style", options };
}

/** The mixture that the real counterpart performs; `undefined` if the style varies over the body or over time. */
function counterpartStyles(state: AppState, neutral: string): StyleWeights | undefined {
  const { styles, parts, track } = engineOptions(state, neutral);
  return track.length === 0 && Object.keys(parts).length === 0 ? styles : undefined;
}
