/** A knob: what is printed, what is said, and what it does. */
export interface KnobWords {
  symbol: string;
  name: string;
  description: string;
}
