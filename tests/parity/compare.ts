/** The first difference of two parity reports. */

/** The first stage that differs, and its first differing frame. */
export interface Difference {
  /** Clip or database and stage. */
  stage: string;
  /** Index of the frame, line or clip; -1 if the common part of the stage is equal, or a report lacks the stage. */
  frame: number;
}

/** Returns the first difference in the order of the stages, or undefined if the reports are equal. */
export function firstDifference(native: string, wasm: string): Difference | undefined {
  const [a, b] = [native, wasm].map((report) => report.trimEnd().split("\n"));
  for (let i = 0; i < Math.max(a!.length, b!.length); i++) {
    const [left, right] = [a![i] ?? "", b![i] ?? ""];
    if (left === right) continue;
    const [stage, ...hashes] = left.split(" ");
    const [otherStage, ...otherHashes] = right.split(" ");
    const common = stage === otherStage ? hashes.slice(0, otherHashes.length) : [];
    return {
      stage: stage || otherStage || "",
      frame: common.findIndex((hash, frame) => hash !== otherHashes[frame]),
    };
  }
  return undefined;
}
