/** The columns of the Compare view: the input, a method, the real counterpart, or one of the two settings. Pure. */
import { type StyleWeights, type StylizeOptions, TRAINED_METHODS } from "../../worker/protocol";
import { METHOD_NAMES } from "../panels/model_panel";
import { fromHash, type PlayState } from "../state";
import { engineOptions } from "../style_settings";

/** What a column may show, as the URL names it. */
export const COLUMN_NAMES = ["input", "mar", "lar", "knn", "nn", ...TRAINED_METHODS, "real", "a", "b"] as const;
export type ColumnName = (typeof COLUMN_NAMES)[number];

/** Fewest and most columns. */
export const LEAST_COLUMNS = 1;
export const MOST_COLUMNS = 5;

/** Names of the columns, as people choose them. */
export const COLUMN_TITLES: Readonly<Record<ColumnName, string>> = {
  input: "Input",
  mar: "Strut, MAR",
  lar: "Local regression",
  knn: "K nearest",
  nn: "Nearest neighbour",
  gar: "Global regression",
  lti: "Linear system",
  gp: "Gaussian process",
  real: "Real counterpart",
  a: "Setting A",
  b: "Setting B",
};

/** What a column shows, in a line. */
export function columnCaption(column: ColumnName, input: string, { k }: PlayState): string {
  switch (column) {
    case "input":
      return `${input}, unchanged`;
    case "mar":
      return `${k} neighbours in each class, a model per frame`;
    case "lar":
      return `${METHOD_NAMES.lar} on ${k} neighbours of all classes`;
    case "knn":
      return `mean of the ${k} closest frames`;
    case "nn":
      return "copies the closest frame";
    case "gar":
      return "one regression on the whole database, trained before";
    case "lti":
      return "a linear time-invariant system, trained before";
    case "gp":
      return "predicts the change of pose, trained before";
    case "real":
      return "the input performed in the style";
    case "a":
    case "b":
      return "as it is set in Play";
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
