/**
 * Keys of style variables over time: pure edits of plain data, used by the URL, the timeline, the pad and the engine.
 */
import { MAX_KEYS, type TimedValue } from "../../state/key_style";

/** Minimum distance of keys, seconds: a frame of the training data. */
export const MIN_GAP = 1 / 30;
/** Keys within this distance of a time count as at that time, seconds. */
const NEAR = MIN_GAP / 2;

/** Index of the key at a time; −1 if there is none. */
export function keyAt(keys: readonly TimedValue[], secs: number): number {
  return keys.findIndex((key) => Math.abs(key.secs - secs) < NEAR);
}

/** Sets a key: an existing key at that time gets the values. `key` is its index. */
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
  // If a new key does not fit between two keys, the nearer one gets the values.
  const [before, next] = [keys[at - 1], keys[at]];
  const crowded = (other: TimedValue | undefined) => other !== undefined && Math.abs(other.secs - secs) < MIN_GAP;
  if (crowded(before)) return { keys: keys.map((key, i) => (i === at - 1 ? { ...key, values } : key)), key: at - 1 };
  if (crowded(next)) return { keys: keys.map((key, i) => (i === at ? { ...key, values } : key)), key: at };
  return { keys: keys.toSpliced(at, 0, { secs, values }), key: at };
}

/** Moves a key in time, but not past its neighbours or out of the animation. */
export function moveKey(keys: readonly TimedValue[], key: number, secs: number, length: number): TimedValue[] {
  const min = key > 0 ? keys[key - 1]!.secs + MIN_GAP : 0;
  const max = key < keys.length - 1 ? keys[key + 1]!.secs - MIN_GAP : length;
  const at = Math.max(min, Math.min(max, secs));
  return keys.map((k, i) => (i === key ? { ...k, secs: at } : k));
}

/** Sets the values of a key. */
export function withValues(keys: readonly TimedValue[], key: number, values: readonly number[]): TimedValue[] {
  return keys.map((k, i) => (i === key ? { ...k, values } : k));
}

export function removeKey(keys: readonly TimedValue[], key: number): TimedValue[] {
  return keys.filter((_, i) => i !== key);
}

/** The keys for another length of the animation: all of them, moved closer together if necessary. */
export function fitted(keys: readonly TimedValue[], length: number): TimedValue[] {
  const last = keys.at(-1)?.secs ?? 0;
  if (last <= length) return [...keys];
  return keys.map((key) => ({ ...key, secs: (key.secs / last) * length }));
}
