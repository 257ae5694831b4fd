/** A search by kd-trees beside the exact one, by the package that has both. */
import type { Database } from "../database";
import { Handle } from "../handle";
import type { Input } from "../input";
import { guarded } from "../wasm";
import * as glue from "./pkg/strut_compare.js";

/** An object of this package that the engine holds under the name of its own. */
const own = <T>(raw: unknown): T => raw as T;

/** The frames of an input on their way through both searches. */
export class SearchComparison extends Handle<glue.SearchComparison> {
  /**
   * @param neighbours how many are looked for in every class
   * @param candidates among how many of its kd-tree
   * @throws StrutError `bad-input` if there are no candidates
   */
  constructor(database: Database, input: Input, neighbours: number, candidates: number) {
    super(
      guarded(() => new glue.SearchComparison(own(database.raw), own(input.raw), neighbours, candidates)),
      "search comparison",
    );
  }

  /** Takes up to `frames` more frames, and gives how many; 0 where all are done. */
  take(frames: number): number {
    return guarded(() => this.raw.take(frames));
  }

  /** Searches the frames taken last exactly. */
  searchExactly(): void {
    guarded(() => this.raw.searchExactly());
  }

  /** Searches them by kd-trees. */
  searchTrees(): void {
    guarded(() => this.raw.searchTrees());
  }

  /** Counts what both have found. */
  count(): void {
    guarded(() => this.raw.count());
  }

  /** Share of the nearest windows that kd-trees have found so far, 0–1. */
  recall(): number {
    return guarded(() => this.raw.recall());
  }
}
