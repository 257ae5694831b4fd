/**
 * Easing of the style weights, so that a jump of the handle does not make the pose jump. The handle itself has no
 * easing (`design/tokens.md`). Pure functions.
 */
import { STYLE_HALF_LIFE_SECS } from "../client/protocol";

/** Smaller differences are not visible. */
const SETTLED = 5e-3;

/** Weight of each style by name; a missing style has weight 0. */
export type Weights = Readonly<Record<string, number>>;

/** Moves `from` towards `to` for a duration; returns exactly `to` once they differ by less than `near`. */
export function approach(from: Weights, to: Weights, dtSecs: number, near = SETTLED): Weights {
  const share = 1 - 2 ** (-dtSecs / STYLE_HALF_LIFE_SECS);
  const names = [...new Set([...Object.keys(from), ...Object.keys(to)])];
  const next = names.map((name): [string, number] => {
    const [before, after] = [weightOf(from, name), weightOf(to, name)];
    return [name, before + (after - before) * share];
  });
  const settled = next.every(([name, weight]) => Math.abs(weightOf(to, name) - weight) < near);
  return settled ? to : Object.fromEntries(next);
}

/** A style may have the name `constructor`: only own properties are weights. */
function weightOf(weights: Weights, name: string): number {
  return Object.hasOwn(weights, name) ? weights[name]! : 0;
}
