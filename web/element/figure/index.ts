/** What figures export. */
export { defineFigure, type StateChange, StrutFigure } from "./figure_element";
export type { Measure } from "./kind";
export type { KindName } from "./kinds";
export { LANGUAGES, type Language, WORDS } from "./languages";
export { PAIR_FIELDS, type PairState } from "./pair_state";
export { figure } from "./words";
