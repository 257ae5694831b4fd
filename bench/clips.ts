/** Time of styling a whole clip of a minute, except for writing the text of a file. */
import { timed } from "./clock";
import { stylizerFor } from "./engine_bench";
import type { Instance } from "./engines";
import type { Mode } from "./report";
import { makeWorkload, POSE_FLOATS, type Query, type Source } from "./workload";

/** A minute at 60 Hz. */
const CLIP_FRAMES = 3600;
/** Number of times that each clip is styled. */
const ROUNDS = 5;

/** A clip that was styled several times. */
export interface ClipRow {
  mode: Mode;
  frames: number;
  median_ms: number;
  least_ms: number;
  /** Size of the linear memory with the database, the clip and its result, megabytes. */
  memory_mb: number;
}

/** Styles a minute of motion outside the database: of one class with its labels, and of all classes without. */
export function timeClips(instance: Instance, source: Source): ClipRow[] {
  const { glue, memory } = instance;
  const { bytes, queries } = makeWorkload(glue, source);
  // Making the workload took more memory than styling does.
  instance.restart();
  const database = glue.Database.fromBytes(bytes);
  return (["labelled", "unlabelled"] as const).map((mode) => {
    const input = glue.inputOf(database, minuteOf(mode === "labelled" ? queries.slice(0, 1) : queries));
    const stylizer = stylizerFor(glue, database, mode, queries[0]!);
    const times = Array.from({ length: ROUNDS }, () =>
      timed(() => {
        const job = new glue.ClipJob(stylizer, input);
        while (job.run(100) < CLIP_FRAMES);
        void [job.poses(), job.timeOut(), job.planted(), job.classWeights()];
        job.free();
      }),
    ).toSorted((a, b) => a - b);
    const memory_mb = memory().buffer.byteLength / 1e6;
    for (const handle of [stylizer, input]) handle.free();
    return { mode, frames: CLIP_FRAMES, median_ms: times[ROUNDS >> 1]!, least_ms: times[0]!, memory_mb };
  });
}

/** Repeats the queries one after the other until they fill a minute. */
function minuteOf(queries: readonly Query[]): Float32Array {
  const minute = new Float32Array(CLIP_FRAMES * POSE_FLOATS);
  let at = 0;
  for (let i = 0; at < minute.length; i++) {
    const part = queries[i % queries.length]!.poses.subarray(0, minute.length - at);
    minute.set(part, at);
    at += part.length;
  }
  return minute;
}

/** Returns one line per clip. */
export function clipLines(rows: readonly ClipRow[]): string {
  const line = ({ mode, frames, median_ms, least_ms, memory_mb }: ClipRow) =>
    `${mode.padEnd(10)}  ${frames} frames  ${median_ms.toFixed(0)} ms (at best ${least_ms.toFixed(0)})  ${memory_mb.toFixed(0)} MB`;
  return rows.map(line).join("\n");
}
