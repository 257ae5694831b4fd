/** Properties of one walker: speed, styles, and the corresponding plan of the Walk view. */

import type { CrowdTick } from "../../../client/crowd/crowd_client";
import type { FieldVertex } from "../../../client/crowd/limits";
import { CROWD_WALKER_FLOATS } from "../../../humanoid";
import { INTENSITY_RANGE, type WalkBlock } from "../../state/walk";
import { spoken } from "../../ui/words";

/** Full weight of a style. */
const FULL = 255;
/** Weights below this are ignored. */
const NEGLIGIBLE = 0.005;
/** Number of ticks over which a speed is measured: about a step. */
const TICKS = 15;
/** Number of steps of a plan. */
const STEPS = 8;

/** Recent positions of one walker. */
export class Strides {
  #walker = -1;
  #places: (readonly [x: number, z: number])[] = [];

  /** Adds a walker's position after a tick; another walker restarts the list. */
  add({ joints }: Pick<CrowdTick, "joints">, walker: number): void {
    if (walker !== this.#walker) this.forget();
    this.#walker = walker;
    const at = CROWD_WALKER_FLOATS * walker;
    this.#places.push([joints[at]!, joints[at + 2]!]);
    if (this.#places.length > TICKS + 1) this.#places.shift();
  }

  forget(): void {
    this.#walker = -1;
    this.#places = [];
  }

  /** Mean speed over about a step, m/s. */
  speed(walker: number, rateHz: number): number {
    const [first, last] = [this.#places[0], this.#places.at(-1)];
    const ticks = this.#places.length - 1;
    if (walker !== this.#walker || !first || !last || ticks < 1) return 0;
    return (Math.hypot(last[0] - first[0], last[1] - first[1]) / ticks) * rateHz;
  }
}

const weightsOf = ({ weights }: Pick<CrowdTick, "weights">, walker: number, styles: readonly string[]) =>
  styles.map((name, i) => ({ name, weight: weights[walker * styles.length + i]! / FULL }));

/** Weights of the field's styles, each once, and of the rest by its name, for one agent, 0 to 1. */
export function sharesOf(
  tick: Pick<CrowdTick, "weights">,
  walker: number,
  styles: readonly string[],
  field: readonly FieldVertex[],
  rest: string,
): { name: string; share: number }[] {
  const all = weightsOf(tick, walker, styles);
  const missing = Math.max(0, 1 - all.reduce((sum, { weight }) => sum + weight, 0));
  const inField = [...new Set(field.map(({ style }) => style))].flatMap((style) =>
    all.filter(({ name }) => name === style),
  );
  return [
    ...inField.map(({ name, weight }) => ({ name: spoken(name), share: weight })),
    { name: rest, share: missing },
  ];
}

/** A block of a plan with an agent's styles. The remainder to 1 is the average of all styles there too. */
export function asWalkBlock(tick: Pick<CrowdTick, "weights">, walker: number, styles: readonly string[]): WalkBlock {
  const all = weightsOf(tick, walker, styles).filter(({ weight }) => weight >= NEGLIGIBLE);
  const sum = all.reduce((total, { weight }) => total + weight, 0);
  const selection = all.map(({ name, weight }) => ({ name, weight: weight / sum }));
  const intensity = Math.min(INTENSITY_RANGE.max, Number(sum.toFixed(INTENSITY_RANGE.digits)));
  return all.length > 0
    ? { styles: selection, intensity, steps: STEPS, transition: 0 }
    : { styles: [{ name: styles[0]!, weight: 1 }], intensity: 0, steps: STEPS, transition: 0 };
}
