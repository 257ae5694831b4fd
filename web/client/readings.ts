/** The classes that the engine recognises in a frame. */
import type { DatabaseInfo, Reading } from "../engine/types";

/** Maximum number of classes that are listed. */
const READS = 3;

/** The classes with the largest weights, largest first; those without weight are left out. */
export function heaviest(
  classes: readonly Pick<DatabaseInfo["classes"][number], "action" | "style">[],
  weights: Float32Array,
): Reading[] {
  return classes
    .map(({ action, style }, i) => ({ action, style, weight: weights[i] ?? 0 }))
    .filter(({ weight }) => weight > 0)
    .sort((a, b) => b.weight - a.weight)
    .slice(0, READS);
}
