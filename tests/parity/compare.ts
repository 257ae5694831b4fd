/** Where two parity reports part. */

/** The first stage that differs, and its first frame that does. */
export interface Difference {
  /** Clip or database and stage. */
  stage: string;
  /** Number of the frame, line or clip; -1 if what both reports have of the stage is the same, or one lacks it. */
  frame: number;
}

/** The first difference in the order of the stages, undefined if the reports are the same. */
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
