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
  const names = [...new Set(blocks.map(mainStyle))].filter((name) => name !== neutral);
  return blocks.map((block) => {
    const name = mainStyle(block);
    return name === neutral ? NEUTRAL : OTHERS[names.indexOf(name) % OTHERS.length]!;
  });
}

/** A colour on the way between two. */
export function mixed(from: string, to: string, share: number): string {
  if (from === to || share <= 0) return from;
  return share >= 1 ? to : `color-mix(in oklab, ${to} ${Math.round(100 * share)}%, ${from})`;
}
