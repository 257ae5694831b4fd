/** Range of a number with a knob or slider, and its decimals. */
export interface Range {
  min: number;
  max: number;
  /** Decimals. */
  digits: number;
}

/** A number clamped to a range, with its decimals; −0 becomes 0. */
export function rounded(value: number, { min, max, digits }: Range): number {
  return Number(Math.min(max, Math.max(min, value)).toFixed(digits)) + 0;
}
