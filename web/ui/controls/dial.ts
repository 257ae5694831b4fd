/** Maps a dial's 270° of travel to its values: linear, or logarithmic for values that act by ratio. Pure functions. */
import type { Range } from "./range";

export interface DialRange extends Range {
  scale: "linear" | "log";
}

const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

/** Position of a value, as a share of the travel, 0–1. */
export function shareOf(value: number, { min, max, scale }: DialRange): number {
  const share = scale === "log" ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min);
  return clamp(share, 0, 1);
}

/** Value at a share of the travel, rounded to the range's decimals. */
export function valueAt(share: number, { min, max, digits, scale }: DialRange): number {
  const t = clamp(share, 0, 1);
  const value = scale === "log" ? min * (max / min) ** t : min + (max - min) * t;
  return clamp(Number(value.toFixed(digits)), min, max);
}

/** The next value in a direction: a share of the travel, but at least one unit of the last decimal. */
export function stepped(value: number, shares: number, range: DialRange): number {
  const next = valueAt(shareOf(value, range) + shares, range);
  if (next !== value || shares === 0) return next;
  return clamp(Number((value + Math.sign(shares) * 10 ** -range.digits).toFixed(range.digits)), range.min, range.max);
}

/** The value typed by the user: a number in range, with a comma or a point; `undefined` if it is invalid. */
export function parseTyped(text: string, range: DialRange): number | undefined {
  const value = Number(text.trim().replace(",", ".").replace("−", "-"));
  if (text.trim() === "" || !Number.isFinite(value)) return undefined;
  return clamp(Number(value.toFixed(range.digits)), range.min, range.max);
}
