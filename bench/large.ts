/** What a database of a million frames takes: memory, and time to open it and to style a frame. */
import { timed } from "./clock";
import { stylizerFor, WARM_UP } from "./engine_bench";
import type { Database, Instance } from "./engines";
import { type Mode, summarise } from "./report";
import { makeWorkload, POSE_FLOATS, type Query } from "./workload";

/** Frames of the database that is measured on. */
export const LARGE_FRAMES = 1_000_000;
/** Frames of the database that the queries are made beside: they are the same with any. */
const FEW_FRAMES = 4800;
/** Times that the file is opened. */
const OPENINGS = 3;
const STYLES = 3;

/** What was measured. */
export interface LargeReport {
  frames: number;
  file_mb: number;
  /** Median, and the longest, which is the first. */
  open_ms: number;
  first_open_ms: number;
  /** Linear memory with the database open, with a stylizer, and with one of three styles. */
  open_mb: number;
  one_style_mb: number;
  three_styles_mb: number;
  /** How long the first frames took, for which the targets of a style are made. */
  style_ms: number;
  /** A frame's times by what is known of the input. */
  frame: Record<"labelled" | "unlabelled" | "unlabelled, 3 styles", { median_ms: number; p95_ms: number }>;
}

/** Measures on a `.strutdb` file of procedural motion. */
export function measureLarge({ glue, memory, restart }: Instance, bytes: Uint8Array): LargeReport {
  const { queries } = makeWorkload(glue, { frames: FEW_FRAMES });
  const openings: number[] = [];
  let database: Database | undefined;
  for (let i = 0; i < OPENINGS; i++) {
    // Memory never shrinks: each opening has an instance of its own.
    restart();
    openings.push(
      timed(() => {
        database = glue.Database.fromBytes(bytes);
      }),
    );
  }
  const megabytes = () => memory().buffer.byteLength / 1e6;
  const open_mb = megabytes();
  const opened = database!;
  const stylizer = new glue.Stylizer(opened);
  const poses = queries[0]!.poses.subarray(0, WARM_UP * POSE_FLOATS);
  // The targets of a style are made when it is first in use.
  const style_ms = timed(() => stylizer.push(poses));
  const one_style_mb = megabytes();
  const thirds = Float32Array.from(opened.styles(), (_, style) => (style < STYLES ? 1 / STYLES : 0));
  stylizer.setStyles(thirds);
  stylizer.push(poses);
  const three_styles_mb = megabytes();
  stylizer.free();

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
    open_mb,
    one_style_mb,
    three_styles_mb,
    style_ms,
    frame: {
      labelled: framesOf("labelled"),
      unlabelled: framesOf("unlabelled"),
      "unlabelled, 3 styles": framesOf("unlabelled", thirds),
    },
  };
  opened.free();
  return report;
}

/** The report as lines. */
export function largeLines(report: LargeReport): string {
  const { frames, file_mb, open_ms, first_open_ms, open_mb, one_style_mb, three_styles_mb, style_ms } = report;
  const mb = (megabytes: number) => `${megabytes.toFixed(0)} MB`;
  const ms = (milliseconds: number) => `${milliseconds.toFixed(milliseconds < 10 ? 3 : 0)} ms`;
  return [
    `${frames} frames, ${mb(file_mb)} on disk`,
    `open       ${ms(open_ms)} (first ${ms(first_open_ms)}), a style's targets ${ms(style_ms)}`,
    `memory     ${mb(open_mb)} open, ${mb(one_style_mb)} with one style, ${mb(three_styles_mb)} with three`,
    ...Object.entries(report.frame).map(
      ([mode, times]) => `frame      ${ms(times.median_ms)}, 95 % within ${ms(times.p95_ms)}, ${mode}`,
    ),
  ].join("\n");
}
