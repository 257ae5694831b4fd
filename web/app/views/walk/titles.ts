/** Names of blocks and plans in words. Pure. */

import type { Selection } from "../../../ui/polygon/selection";
import type { WalkBlock } from "../../state/walk";
import { strings } from "../../strings/strings";
import { capitalised, manner, numberWord, spoken } from "../../ui/words";

/** Intensities within this distance of 0 or 1 count as these. */
const NEAR = 0.05;
/** Weights below this are not named. */
const MIN_WEIGHT = 0.005;

/** Description of a block: `very old`, or `proud left, old right`. */
export function blockName({ styles, right, intensity }: WalkBlock, neutral = ""): string {
  if (Math.abs(intensity) < NEAR) return strings.walk.averageStyle;
  const nameOf = (selection: Selection) => {
    const named = selection.filter(({ weight }) => Math.abs(weight) > MIN_WEIGHT);
    return named.length === 1 ? spoken(named[0]!.name) : manner(selection, 1, neutral);
  };
  const name = right ? strings.walk.limping(nameOf(styles), nameOf(right)) : nameOf(styles);
  if (intensity < 0) return strings.walk.opposite(name);
  if (intensity > 1 + NEAR) return strings.walk.very(name);
  return intensity < 1 - NEAR ? strings.walk.slightly(name) : name;
}

/** Length of a plan and its number of styles: `22 steps, three styles`. */
export function planTitle(blocks: readonly WalkBlock[], steps: number, neutral: string | undefined): string {
  const all = blocks.flatMap(({ styles, right }) => [...styles, ...(right ?? [])]);
  const names = new Set(all.filter(({ weight }) => weight !== 0).map(({ name }) => name));
  if (names.size === 0 && neutral !== undefined) names.add(neutral);
  return strings.walk.title(
    strings.walk.steps(steps, capitalised(numberWord(steps))),
    strings.walk.styles(names.size, numberWord(names.size)),
  );
}
