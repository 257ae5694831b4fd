/** Results of a benchmark run, as `--json` writes them. */
import type { Memory } from "./memory";

/** Labels of the input that are set, and which classes are used (as in `strut bench`). */
export const MODES = ["labelled", "unlabelled", "all"] as const;
export type Mode = (typeof MODES)[number];

/** The engine compiled with and without SIMD, and the reference implementations. */
export const ENGINES = ["wasm-simd", "wasm-scalar", "wasm-naive", "js-naive"] as const;
export type EngineName = (typeof ENGINES)[number];

/** A stage's times over all frames. */
export interface Row {
  stage: string;
  /** `batch`: of {@link GraphicsComparison}, many windows together; the engine searches for them one by one. */
  mode: Mode | "batch";
  engine: EngineName | "native" | "gpu-brute";
  frames: number;
  classes: number;
  median_ms: number;
  p95_ms: number;
}

/** Differences between a reference implementation's results and the engine's. */
export interface Agreement {
  engine: EngineName;
  mode: Mode;
  /** Number of sets of neighbours, one per class and frame, … */
  neighbour_sets: number;
  /** … number of those that equal the engine's, … */
  identical: number;
  /** … and of those that differ only in neighbours that are as distant as the last one, except for rounding. */
  tied: number;
  /** Largest difference of a predicted joint angle (radians) or of the height of the hips (metres). */
  largest_difference: number;
  /** Largest difference of a frame's duration, milliseconds. */
  largest_duration_difference_ms: number;
  /** Largest difference of a probability of contact. */
  largest_contact_difference: number;
}

/** The exhaustive search on a GPU, compared with the engine's. `strut bench --gpu` writes it, too. */
export interface GraphicsComparison {
  adapter: string;
  driver: string;
  backend: string;
  /** Whether the GPU is emulated in software: then there are no times. */
  software: boolean;
  frames: number;
  classes: number;
  /**
   * Number of sets of neighbours, one per window and class, and number of those that are bit-identical to the engine's.
   */
  sets: number;
  identical: number;
  candidates_per_neighbour: number;
  /** Ratio of the median search times, GPU to engine from a cold start. */
  engine_is_faster?: { all: number; batch: number };
}

/** The whole report. */
export interface Report {
  machine: string;
  rows: Row[];
  agreement: Agreement[];
  memory: Memory[];
  /** Present if a GPU was measured. */
  gpu?: GraphicsComparison;
}

/** Returns median and 95th percentile of samples; NaN without samples. */
export function summarise(samples: readonly number[]): Pick<Row, "median_ms" | "p95_ms"> {
  const sorted = [...samples].sort((a, b) => a - b);
  const percentile = (share: number) => sorted[Math.max(Math.ceil(share * sorted.length), 1) - 1] ?? Number.NaN;
  return { median_ms: percentile(0.5), p95_ms: percentile(0.95) };
}

/** Returns the median of a stage, or undefined if it was not measured. */
export function medianOf(report: Report, engine: Row["engine"], mode: Row["mode"], stage: string): number | undefined {
  return report.rows.find((r) => r.engine === engine && r.mode === mode && r.stage === stage)?.median_ms;
}

/** Returns how many times faster the engine with SIMD is than a reference implementation. */
export function speedUp(report: Report, yardstick: EngineName, mode: Mode, stage = "frame"): number {
  const [engine, naive] = [medianOf(report, "wasm-simd", mode, stage), medianOf(report, yardstick, mode, stage)];
  return naive! / engine!;
}
