/** Range of a number with a knob or slider, and its decimals. */
export interface Range {
  min: number;
  max: number;
  /** Decimals. */
  digits: number;
}
