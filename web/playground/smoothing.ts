/** Smoothing of the styles' weights, so that a jump of the handle is a change of manner and not a jerk. Pure. */

/** Time in which half of the way to a new style is gone (`design/tokens.md`: the handle has no easing, the style has). */
export const STYLE_HALF_LIFE_SECS = 0.1;
/** Differences below this are not seen. */
const SETTLED = 5e-3;

/** Weight of each style by name; a missing style weighs nothing. */
export type Weights = Readonly<Record<string, number>>;

/** `from` moved towards `to` for a time; exactly `to` once they cannot be told apart. */
export function approach(from: Weights, to: Weights, dtSecs: number): Weights {
  const share = 1 - 2 ** (-dtSecs / STYLE_HALF_LIFE_SECS);
  const names = [...new Set([...Object.keys(from), ...Object.keys(to)])];
  const next = Object.fromEntries(
    names.map((name) => [name, (from[name] ?? 0) + ((to[name] ?? 0) - (from[name] ?? 0)) * share]),
  );
  const settled = names.every((name) => Math.abs((to[name] ?? 0) - next[name]!) < SETTLED);
  return settled ? to : next;
}
