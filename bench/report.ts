/** What a run of the benchmark finds, as `--json` writes it. */
import type { Memory } from "./memory";

/** What the engine is told of the input, and how many classes take part (as in `strut bench`). */
export const MODES = ["labelled", "unlabelled", "all"] as const;
export type Mode = (typeof MODES)[number];

/** The engine compiled with and without SIMD, and the yardsticks. */
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

/** How far a yardstick's results are from the engine's. */
export interface Agreement {
  engine: EngineName;
  mode: Mode;
  /** Sets of neighbours, one a class and frame, … */
  neighbour_sets: number;
  /** … those that are the engine's, … */
  identical: number;
  /** … and those that differ in neighbours as far away as the last but for rounding. */
  tied: number;
  /** Largest difference of a predicted joint angle (radians) or of the height of the hips (metres). */
  largest_difference: number;
  /** Largest difference of a frame's duration, milliseconds. */
  largest_duration_difference_ms: number;
  /** Largest difference of the likelihood that a foot is planted. */
  largest_contact_difference: number;
}

/** The exhaustive search by a graphics processor beside the engine's, as `strut bench --gpu` writes it, too. */
export interface GraphicsComparison {
  adapter: string;
  driver: string;
  backend: string;
  /** Whether a program plays the graphics processor: then there are no times. */
  software: boolean;
  frames: number;
  classes: number;
  /** Sets of neighbours, one a window and class, and how many are the engine's to the bit. */
  sets: number;
  identical: number;
  candidates_per_neighbour: number;
  /** How many times faster the engine's search from a cold start is, in medians. */
  engine_is_faster?: { all: number; batch: number };
}

/** Everything. */
export interface Report {
  machine: string;
  rows: Row[];
  agreement: Agreement[];
  memory: Memory[];
  /** Where a graphics processor was measured. */
  gpu?: GraphicsComparison;
}

/** Median and 95th percentile of samples, NaN of none. */
export function summarise(samples: readonly number[]): Pick<Row, "median_ms" | "p95_ms"> {
  const sorted = [...samples].sort((a, b) => a - b);
  const percentile = (share: number) => sorted[Math.max(Math.ceil(share * sorted.length), 1) - 1] ?? Number.NaN;
  return { median_ms: percentile(0.5), p95_ms: percentile(0.95) };
}

/** The median of a stage; undefined where it was not measured. */
export function medianOf(report: Report, engine: Row["engine"], mode: Row["mode"], stage: string): number | undefined {
  return report.rows.find((r) => r.engine === engine && r.mode === mode && r.stage === stage)?.median_ms;
}

/** How many times faster than a yardstick the engine with SIMD is. */
export function speedUp(report: Report, yardstick: EngineName, mode: Mode, stage = "frame"): number {
  const [engine, naive] = [medianOf(report, "wasm-simd", mode, stage), medianOf(report, yardstick, mode, stage)];
  return naive! / engine!;
}
