/** Data of a benchmark: a database file, and motion outside the database. */
import type { Glue } from "./engines";

/** Numbers of one pose. */
export const POSE_FLOATS = 87;

/** Motion of a known class. */
export interface Query {
  action: number;
  style: number;
  /** Poses, one after another. */
  poses: Float32Array;
  frames: number;
}

/** A database as bytes, and queries. */
export interface Workload {
  bytes: Uint8Array;
  queries: Query[];
}

/** Source of a workload: a number of procedural frames, or a database file, of which some clips are held out. */
export type Source = { frames: number } | { database: Uint8Array };

/** Makes a workload. */
export function makeWorkload(glue: Glue, source: Source): Workload {
  const made = "frames" in source ? glue.Workload.procedural(source.frames) : glue.Workload.heldOutOf(source.database);
  const queries = Array.from({ length: made.queries() }, (_, query) => {
    const poses = made.poses(query);
    return { action: made.action(query), style: made.style(query), poses, frames: poses.length / POSE_FLOATS };
  });
  const bytes = made.database();
  made.free();
  return { bytes, queries };
}
