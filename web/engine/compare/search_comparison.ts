/** Compares a search by kd-trees with the exact one, in the package that has both. */
import type { Database } from "../database";
import { Handle } from "../handle";
import type { Input } from "../input";
import { guarded } from "../wasm";
import * as glue from "./pkg/strut_compare.js";

/** Casts an object of this package to the engine's type of the same class. */
const own = <T>(raw: unknown): T => raw as T;

/** Runs the frames of an input through both searches. */
export class SearchComparison extends Handle<glue.SearchComparison> {
  /**
   * @param neighbours number of neighbours in every class
   * @param candidates number of candidates that the kd-tree examines
   * @throws StrutError `bad-input` if there are no candidates
   */
  constructor(database: Database, input: Input, neighbours: number, candidates: number) {
    super(
      guarded(() => new glue.SearchComparison(own(database.raw), own(input.raw), neighbours, candidates)),
      "search comparison",
    );
  }

  /** Takes up to `frames` more frames. Returns their number; 0 if all are done. */
  take(frames: number): number {
    return guarded(() => this.raw.take(frames));
  }

  /** Searches the frames taken last with the exact search. */
  searchExactly(): void {
    guarded(() => this.raw.searchExactly());
  }

  /** Searches the frames taken last with the kd-trees. */
  searchTrees(): void {
    guarded(() => this.raw.searchTrees());
  }

  /** Compares the results of both searches and adds them to the recall. */
  count(): void {
    guarded(() => this.raw.count());
  }

  /** Share of the nearest windows that kd-trees have found so far, 0–1. */
  recall(): number {
    return guarded(() => this.raw.recall());
  }
}
