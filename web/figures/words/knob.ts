/** Texts of a knob: symbol, accessible name, and description. */
export interface KnobWords {
  symbol: string;
  name: string;
  description: string;
}
