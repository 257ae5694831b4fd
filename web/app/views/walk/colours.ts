/** Colours of blocks: blocks of the same style have the same colour. */
import type { WalkBlock } from "../../state/walk";
import { mainStyle } from "./plan";

/** The neutral style has the colour of inputs; the others cycle through the rest. */
const NEUTRAL = "var(--input)";
const OTHERS = [
  "var(--signal)",
  "var(--weight)",
  "color-mix(in oklab, var(--signal) 50%, var(--input))",
  "color-mix(in oklab, var(--weight) 45%, var(--input))",
  "color-mix(in oklab, var(--signal) 55%, var(--weight))",
  "color-mix(in oklab, var(--input) 45%, var(--ink2))",
];

/** The CSS colours of blocks. */
export function coloursOf(blocks: readonly WalkBlock[], neutral: string | undefined): string[] {
  // A style and its opposite differ more than most.
  const kinds = blocks.map((block) => `${block.intensity < 0 ? "−" : ""}${mainStyle(block)}`);
  const others = [...new Set(kinds)].filter((kind) => kind !== neutral);
  return kinds.map((kind) => (kind === neutral ? NEUTRAL : OTHERS[others.indexOf(kind) % OTHERS.length]!));
}

/** A mixture of two colours; `share` of the second one. */
export function mixed(from: string, to: string, share: number): string {
  if (from === to || share <= 0) return from;
  return share >= 1 ? to : `color-mix(in oklab, ${to} ${Math.round(100 * share)}%, ${from})`;
}
