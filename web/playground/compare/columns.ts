/** The columns of the Compare view: the input, a method, or one of the two settings. Pure. */
import type { Method, StylizeOptions } from "../../worker/protocol";
import { METHOD_NAMES } from "../panels/model_panel";
import { fromHash, type PlayState } from "../state";
import { engineOptions } from "../style_settings";

/** What a column may show, as the URL names it. */
export const COLUMN_NAMES = ["input", "mar", "lar", "knn", "nn", "a", "b"] as const;
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
    case "a":
    case "b":
      return "as it is set in Play";
  }
}

/** What the engine is asked for in a column; `undefined` for the input, which is not styled. */
export function columnOptions(column: ColumnName, state: PlayState, neutral: string): StylizeOptions | undefined {
  if (column === "input") return undefined;
  if (column !== "a" && column !== "b") return { ...engineOptions(state, neutral), method: column satisfies Method };
  if (state.side === column || state.other === "") return engineOptions(state, neutral);
  return engineOptions(fromHash(state.other), neutral);
}
