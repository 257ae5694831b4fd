/** What a run of the benchmark finds, as `--json` writes it. */

/** What the engine is told of the input, and how many classes take part (as in `strut bench`). */
export const MODES = ["labelled", "unlabelled", "all"] as const;
export type Mode = (typeof MODES)[number];

/** The engine compiled with and without SIMD, and the yardsticks. */
export const ENGINES = ["wasm-simd", "wasm-scalar", "wasm-naive", "js-naive"] as const;
export type EngineName = (typeof ENGINES)[number];

/** A stage's times over all frames. */
export interface Row {
  stage: string;
  mode: Mode;
  engine: EngineName | "native";
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

/** Megabytes of WASM memory with the database open, and with so many styles in use. */
export interface Memory {
  engine: EngineName;
  open_mb: number;
  one_style_mb: number;
  three_styles_mb: number;
}

/** Everything. */
export interface Report {
  machine: string;
  rows: Row[];
  agreement: Agreement[];
  memory: Memory[];
}

/** Median and 95th percentile of samples, NaN of none. */
export function summarise(samples: readonly number[]): Pick<Row, "median_ms" | "p95_ms"> {
  const sorted = [...samples].sort((a, b) => a - b);
  const percentile = (share: number) => sorted[Math.max(Math.ceil(share * sorted.length), 1) - 1] ?? Number.NaN;
  return { median_ms: percentile(0.5), p95_ms: percentile(0.95) };
}

/** The median of a stage; undefined where it was not measured. */
export function medianOf(report: Report, engine: Row["engine"], mode: Mode, stage: string): number | undefined {
  return report.rows.find((r) => r.engine === engine && r.mode === mode && r.stage === stage)?.median_ms;
}

/** How many times faster than a yardstick the engine with SIMD is. */
export function speedUp(report: Report, yardstick: EngineName, mode: Mode, stage = "frame"): number {
  const [engine, naive] = [medianOf(report, "wasm-simd", mode, stage), medianOf(report, yardstick, mode, stage)];
  return naive! / engine!;
}
