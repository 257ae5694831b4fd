/** Memory of a database of a million frames, and the time to open it and to style a frame. */
import { timed } from "./clock";
import { stylizerFor, WARM_UP } from "./engine_bench";
import type { Database, Instance } from "./engines";
import { evenStyles, type Memory, measureMemory } from "./memory";
import { type Mode, summarise } from "./report";
import { aligned, memoryTable } from "./table";
import { makeWorkload, POSE_FLOATS, type Query } from "./workload";

/** Number of frames of the measured database. */
export const LARGE_FRAMES = 1_000_000;
/** Number of frames of the database with which the queries are made: the queries do not depend on it. */
const FEW_FRAMES = 4800;
/** Number of times that the file is opened. */
const OPENINGS = 3;

/** Results of the measurement. */
export interface LargeReport {
  frames: number;
  file_mb: number;
  /** Median, and maximum, which is the first opening. */
  open_ms: number;
  first_open_ms: number;
  memory: Memory;
  /** Times of a frame by the known labels of the input. */
  frame: Record<"labelled" | "unlabelled" | "unlabelled, 3 styles", { median_ms: number; p95_ms: number }>;
}

/** Measures a `.strutdb` file of procedural motion. */
export function measureLarge(instance: Instance, bytes: Uint8Array): LargeReport {
  const { glue, restart } = instance;
  const { queries } = makeWorkload(glue, { frames: FEW_FRAMES });
  const openings: number[] = [];
  let database: Database | undefined;
  for (let i = 0; i < OPENINGS; i++) {
    // Memory never shrinks, so each opening has a new instance.
    restart();
    openings.push(
      timed(() => {
        database = glue.Database.fromBytes(bytes);
      }),
    );
  }
  const opened = database!;
  const memory = measureMemory(instance, "wasm-simd", opened, queries);

  const framesOf = (mode: Mode, styles?: Float32Array) => summarise(queries.flatMap((q) => timesOf(mode, q, styles)));
  const timesOf = (mode: Mode, query: Query, styles: Float32Array | undefined) => {
    const stream = stylizerFor(glue, opened, mode, query);
    if (styles) stream.setStyles(styles);
    const pose = (frame: number) => query.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
    const times = Array.from({ length: query.frames }, (_, frame) => timed(() => stream.push(pose(frame))));
    stream.free();
    return times.slice(WARM_UP);
  };
  const sorted = openings.toSorted((a, b) => a - b);
  const report: LargeReport = {
    frames: opened.frames(),
    file_mb: bytes.byteLength / 1e6,
    open_ms: sorted[OPENINGS >> 1]!,
    first_open_ms: openings[0]!,
    memory,
    frame: {
      labelled: framesOf("labelled"),
      unlabelled: framesOf("unlabelled"),
      "unlabelled, 3 styles": framesOf("unlabelled", evenStyles(opened)),
    },
  };
  opened.free();
  return report;
}

/** Returns the report as lines. */
export function largeLines(report: LargeReport): string {
  const { frames, file_mb, open_ms, first_open_ms, memory } = report;
  const mb = (megabytes: number) => `${megabytes.toFixed(0)} MB`;
  const ms = (milliseconds: number) => `${milliseconds.toFixed(milliseconds < 10 ? 3 : 0)} ms`;
  return [
    `${frames} frames, ${mb(file_mb)} on disk`,
    `open       ${ms(open_ms)} (first ${ms(first_open_ms)})`,
    aligned(memoryTable([memory])),
    ...Object.entries(report.frame).map(
      ([mode, times]) => `frame      ${ms(times.median_ms)}, 95 % within ${ms(times.p95_ms)}, ${mode}`,
    ),
  ].join("\n");
}
