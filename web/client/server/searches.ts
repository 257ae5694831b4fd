/** Calls about the search for neighbours. */
import type { Database } from "../../engine/database";
import type { Input } from "../../engine/input";
import type { SearchFigures } from "../protocol";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import type { Host } from "./host";
import { carriedMotion } from "./motions";
import { stage } from "./time_slices";

/** Both searches of an input, in portions: the part of `SearchComparison` (`engine/compare/`) that is needed. */
interface SearchJob {
  take(frames: number): number;
  searchExactly(): void;
  searchTrees(): void;
  count(): void;
  recall(): number;
  dispose(): void;
}

/** Creates the comparison of a search by kd-trees with the exact one. */
export type Searches = (database: Database, input: Input, neighbours: number, candidates: number) => SearchJob;

/** Frames per portion. */
const PORTION = 8;

/**
 * Searches a whole motion exactly and by kd-trees, in time slices.
 * @throws StrutError `cancelled`, also if the motion or the database is closed meanwhile
 */
export async function compareSearch(
  searches: Searches,
  host: Host,
  caller: Caller,
  motion: number,
  database: number,
  neighbours: number,
  candidates: number,
): Promise<SearchFigures> {
  const { open } = host;
  const carried = await carriedMotion(host, caller, motion, database);
  const { input } = carried;
  const job = searches(open.get(OpenDatabase, database).database, input, neighbours, candidates);
  const isCancelled = () => caller.isCancelled() || !open.has(carried);
  try {
    return await figuresOf(job, input.info.frames, { ...caller, isCancelled });
  } finally {
    job.dispose();
  }
}

/** Recall and the mean cost of a frame; a median would be 0 if the clock has a resolution of whole milliseconds. */
async function figuresOf(job: SearchJob, frames: number, caller: Caller): Promise<SearchFigures> {
  let [done, exactMs, treesMs] = [0, 0, 0];
  for (;;) {
    const taken = job.take(PORTION);
    if (taken === 0) return { recall: job.recall(), exactMs: exactMs / (done || 1), treesMs: treesMs / (done || 1) };
    exactMs += msOf(() => job.searchExactly());
    treesMs += msOf(() => job.searchTrees());
    job.count();
    done += taken;
    await stage(caller, "Searching the clip", done / frames);
  }
}

function msOf(work: () => void): number {
  const started = performance.now();
  work();
  return performance.now() - started;
}
