/**
 * Keys of style variables over time: pure edits of plain data. The URL, the timeline, the pad and the engine all speak in
 * these.
 */
import type { Range } from "../fields";

/** Values of the style variables, in their own units, at a time. */
export interface TimedValue {
  secs: number;
  values: readonly number[];
}

export const MOST_KEYS = 60;
/** Length of the animation, seconds. */
export const LENGTH_RANGE = { min: 0.5, max: 30, digits: 2 } as const satisfies Range;
/** Keys are so far apart at least, seconds: a frame of the training data. */
export const LEAST_GAP = 1 / 30;
/** A key this near is the one that is meant, seconds. */
const NEAR = LEAST_GAP / 2;

/** Number of the key at a time; −1 where there is none. */
export function keyAt(keys: readonly TimedValue[], secs: number): number {
  return keys.findIndex((key) => Math.abs(key.secs - secs) < NEAR);
}

/** Sets a key: where there is one at that time it takes the values. `key` is its number. */
export function setKey(
  keys: readonly TimedValue[],
  secs: number,
  values: readonly number[],
): { keys: TimedValue[]; key: number } {
  const present = keyAt(keys, secs);
  if (present >= 0) return { keys: keys.map((key, i) => (i === present ? { ...key, values } : key)), key: present };
  if (keys.length >= MOST_KEYS) return { keys: [...keys], key: -1 };
  const after = keys.findIndex((key) => key.secs > secs);
  const at = after < 0 ? keys.length : after;
  // Between two keys that leave less room than two gaps, the nearer one is meant.
  const [before, next] = [keys[at - 1], keys[at]];
  const crowded = (other: TimedValue | undefined) => other !== undefined && Math.abs(other.secs - secs) < LEAST_GAP;
  if (crowded(before)) return { keys: keys.map((key, i) => (i === at - 1 ? { ...key, values } : key)), key: at - 1 };
  if (crowded(next)) return { keys: keys.map((key, i) => (i === at ? { ...key, values } : key)), key: at };
  return { keys: keys.toSpliced(at, 0, { secs, values }), key: at };
}

/** Moves a key in time, not past its neighbours nor out of the animation. */
export function moveKey(keys: readonly TimedValue[], key: number, secs: number, length: number): TimedValue[] {
  const least = key > 0 ? keys[key - 1]!.secs + LEAST_GAP : 0;
  const most = key < keys.length - 1 ? keys[key + 1]!.secs - LEAST_GAP : length;
  const at = Math.max(least, Math.min(most, secs));
  return keys.map((k, i) => (i === key ? { ...k, secs: at } : k));
}

/** Gives a key other values. */
export function withValues(keys: readonly TimedValue[], key: number, values: readonly number[]): TimedValue[] {
  return keys.map((k, i) => (i === key ? { ...k, values } : k));
}

export function removeKey(keys: readonly TimedValue[], key: number): TimedValue[] {
  return keys.filter((_, i) => i !== key);
}

/** What is left of the keys where the animation has another length: all of them, closer together where they must be. */
export function fitted(keys: readonly TimedValue[], length: number): TimedValue[] {
  const last = keys.at(-1)?.secs ?? 0;
  if (last <= length) return [...keys];
  return keys.map((key) => ({ ...key, secs: (key.secs / last) * length }));
}

/** Decimals of seconds and of values in links. */
const DIGITS = { secs: 2, value: 2 };

/** `0.55_24.5_86.4;…`: seconds, then the values. */
export function encodeTimed(timed: readonly TimedValue[]): string {
  const plain = (value: number, digits: number) => String(Number(value.toFixed(digits)));
  return timed
    .map(({ secs, values }) => [plain(secs, DIGITS.secs), ...values.map((v) => plain(v, DIGITS.value))].join("_"))
    .join(";");
}

/** What {@link encodeTimed} wrote; `undefined` where it is none: times must grow and all have as many values. */
export function decodeTimed(text: string, most: number): TimedValue[] | undefined {
  if (text === "") return [];
  const timed = text.split(";").map((entry): TimedValue => {
    const [secs, ...values] = entry.split("_").map((part) => (part === "" ? Number.NaN : Number(part)));
    return { secs: secs!, values };
  });
  const valid = timed.every(
    ({ secs, values }, i) =>
      secs >= 0 &&
      secs <= LENGTH_RANGE.max &&
      (i === 0 || secs > timed[i - 1]!.secs) &&
      values.length > 0 &&
      values.length === timed[0]!.values.length &&
      values.every(Number.isFinite),
  );
  return valid && timed.length <= most ? timed : undefined;
}
