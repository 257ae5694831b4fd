/** A colour for every block: the same style has the same one wherever it is walked. */
import { mainStyle, type WalkBlock } from "./plan";

/** The neutral style is what comes in; the others take turns. */
const NEUTRAL = "var(--input)";
const OTHERS = [
  "var(--signal)",
  "var(--weight)",
  "color-mix(in oklab, var(--signal) 50%, var(--input))",
  "color-mix(in oklab, var(--weight) 45%, var(--input))",
  "color-mix(in oklab, var(--signal) 55%, var(--weight))",
  "color-mix(in oklab, var(--input) 45%, var(--ink2))",
];

/** The colours of blocks, as CSS has them. */
export function coloursOf(blocks: readonly WalkBlock[], neutral: string | undefined): string[] {
  // A style and its opposite differ more than most.
  const kinds = blocks.map((block) => `${block.intensity < 0 ? "−" : ""}${mainStyle(block)}`);
  const others = [...new Set(kinds)].filter((kind) => kind !== neutral);
  return kinds.map((kind) => (kind === neutral ? NEUTRAL : OTHERS[others.indexOf(kind) % OTHERS.length]!));
}

/** A colour on the way between two. */
export function mixed(from: string, to: string, share: number): string {
  if (from === to || share <= 0) return from;
  return share >= 1 ? to : `color-mix(in oklab, ${to} ${Math.round(100 * share)}%, ${from})`;
}
