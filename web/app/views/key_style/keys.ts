/**
 * Keys of style variables over time: pure edits of plain data. The URL, the timeline, the pad and the engine all use
 * these.
 */
import { MAX_KEYS, type TimedValue } from "../../state/key_style";

/** Keys are so far apart at least, seconds: a frame of the training data. */
export const MIN_GAP = 1 / 30;
/** Keys nearer to a time than this are at that time, seconds. */
const NEAR = MIN_GAP / 2;

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
  if (keys.length >= MAX_KEYS) return { keys: [...keys], key: -1 };
  const after = keys.findIndex((key) => key.secs > secs);
  const at = after < 0 ? keys.length : after;
  // Where a new key does not fit between two keys, the nearer one takes the values.
  const [before, next] = [keys[at - 1], keys[at]];
  const crowded = (other: TimedValue | undefined) => other !== undefined && Math.abs(other.secs - secs) < MIN_GAP;
  if (crowded(before)) return { keys: keys.map((key, i) => (i === at - 1 ? { ...key, values } : key)), key: at - 1 };
  if (crowded(next)) return { keys: keys.map((key, i) => (i === at ? { ...key, values } : key)), key: at };
  return { keys: keys.toSpliced(at, 0, { secs, values }), key: at };
}

/** Moves a key in time, not past its neighbours nor out of the animation. */
export function moveKey(keys: readonly TimedValue[], key: number, secs: number, length: number): TimedValue[] {
  const min = key > 0 ? keys[key - 1]!.secs + MIN_GAP : 0;
  const max = key < keys.length - 1 ? keys[key + 1]!.secs - MIN_GAP : length;
  const at = Math.max(min, Math.min(max, secs));
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
