/** State of the Walk view: the plan of a walk and how it is walked. */

import { choice, decodeEntries, encodeEntries, type Fields, flag, listed, number, text } from "../../link/fields";
import type { Range } from "../../ui/controls/range";
import type { Selection } from "../../ui/polygon/selection";

/** Some steps in one mixture of styles, or in one for each foot. */
export interface WalkBlock {
  styles: Selection;
  /** Styles of the right foot's steps, if they differ from {@link styles}, which are then those of the left foot. */
  right?: Selection | undefined;
  /** Factor of the styles' weights: 0 is the average of all styles, above 1 exaggerates, below 0 is the opposite. */
  intensity: number;
  /** Number of steps with this mixture, at least 1. */
  steps: number;
  /** Number of transition steps before it. */
  transition: number;
}

export interface WalkState {
  /** Blocks of the plan; empty until a model is open. */
  walk: readonly WalkBlock[];
  /** Index of the selected block, and whether its whole polygon is mixed. */
  walkBlock: number;
  walkWhole: boolean;
  /** Step durations: as in the model, sampled from it, or fixed, and then the steps per minute. */
  walkTempo: WalkTempo;
  walkCadence: number;
  /** Step length, % of the style's. */
  walkStride: number;
  /** Turn of a step to the left, degrees. */
  walkTurn: number;
  /** Whether the walk is shown as a strip of its steps. */
  walkStrip: boolean;
  /** The plotted quantity of the selected block. */
  walkPlot: string;
}

export const WALK_TEMPOS = ["model", "sampled", "fixed"] as const;
export type WalkTempo = (typeof WALK_TEMPOS)[number];

/** Maximum number of blocks of a plan. */
export const MAX_BLOCKS = 12;
export const STEP_RANGE = { min: 1, max: 16, digits: 0 } as const satisfies Range;
export const TRANSITION_RANGE = { min: 0, max: 8, digits: 0 } as const satisfies Range;
export const INTENSITY_RANGE = { min: -2, max: 3, digits: 2 } as const satisfies Range;

export const WALK_RANGES = {
  cadence: { min: 50, max: 180, digits: 0 },
  stride: { min: 60, max: 130, digits: 0 },
  turn: { min: -10, max: 10, digits: 0 },
} as const satisfies Record<string, Range>;

/** Prefix of the styles of a block's right foot. */
const RIGHT = "r";

/**
 * Encodes a walk: intensity, steps and transition steps before a block's styles; the styles of the right foot follow if
 * they differ: `1_4_2~proud:1`.
 */
function encodeWalk(blocks: readonly WalkBlock[]): string {
  const numbers = ({ intensity, steps, transition }: WalkBlock) =>
    [Number(intensity.toFixed(INTENSITY_RANGE.digits)), steps, transition].join("_");
  return encodeEntries(
    blocks.flatMap((block) => [
      [numbers(block), block.styles] as const,
      ...(block.right ? [[RIGHT, block.right] as const] : []),
    ]),
  );
}

function decodeWalk(text: string): WalkBlock[] | undefined {
  const blocks = decodeEntries(text, 2 * MAX_BLOCKS)?.flatMap(([name, styles], i, entries): WalkBlock[] => {
    if (name === RIGHT && i > 0) return [];
    const [intensity, steps, transition] = name
      .split("_")
      .map((number) => (number === "" ? Number.NaN : Number(number)));
    const [after, right] = entries[i + 1] ?? [];
    const block = {
      styles,
      intensity: intensity ?? Number.NaN,
      steps: steps ?? Number.NaN,
      transition: transition ?? Number.NaN,
    };
    return [after === RIGHT ? { ...block, right: right! } : block];
  });
  const within = (value: number, { min, max, digits }: Range) =>
    value >= min && value <= max && (digits > 0 || Number.isInteger(value));
  const valid = blocks?.every(
    ({ intensity, steps, transition }) =>
      within(intensity, INTENSITY_RANGE) && within(steps, STEP_RANGE) && within(transition, TRANSITION_RANGE),
  );
  return valid && blocks!.length <= MAX_BLOCKS ? blocks : undefined;
}

export const WALK_FIELDS: Fields<WalkState> = {
  walk: listed("walk", [], encodeWalk, decodeWalk),
  walkBlock: number("block", 0, { min: 0, max: MAX_BLOCKS - 1, digits: 0 }, false),
  walkWhole: flag("walkall", false, true),
  walkTempo: choice("tempo", "model", WALK_TEMPOS, true),
  walkCadence: number("cadence", 110, WALK_RANGES.cadence, true),
  walkStride: number("stride", 100, WALK_RANGES.stride, true),
  walkTurn: number("turn", 0, WALK_RANGES.turn, true),
  walkStrip: flag("strip", false, false),
  walkPlot: text("plot", "states", false),
};
