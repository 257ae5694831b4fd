/** The built-in motions for the server's calls. */
import { type BuiltInSet, loadBuiltIn, type PackedMotions } from "../../engine/built_in";
import { loadedOnce } from "../../engine/loaded_once";
import type { Caller } from "../rpc_server";

/** Share of the download in the progress of opening. */
const DOWNLOAD_SHARE = 0.8;

/** The sets of built-in motions, each loaded once. After a failed load, another attempt is made when the set is needed. */
export class BuiltInMotions {
  readonly #sets = new Map<BuiltInSet, LoadingSet>();

  /** Starts to load a set that will be needed. */
  preload(set: BuiltInSet): void {
    void this.#setOf(set)
      .start()
      .catch(() => {});
  }

  load(caller: Caller, set: BuiltInSet = "built-in"): Promise<PackedMotions> {
    return this.#setOf(set).load(caller);
  }

  #setOf(name: BuiltInSet): LoadingSet {
    const known = this.#sets.get(name);
    if (known) return known;
    const set = new LoadingSet(name);
    this.#sets.set(name, set);
    return set;
  }
}

class LoadingSet {
  #fraction = 0;
  readonly #waiting = new Set<Caller>();

  constructor(private readonly name: BuiltInSet) {}

  async load(caller: Caller): Promise<PackedMotions> {
    this.#waiting.add(caller);
    try {
      this.#report(caller);
      return await this.start();
    } finally {
      this.#waiting.delete(caller);
    }
  }

  /** Starts to load the set, unless it is loaded. */
  readonly start = loadedOnce(() => {
    const received = (fraction: number) => {
      this.#fraction = fraction;
      for (const caller of this.#waiting) this.#report(caller);
    };
    return loadBuiltIn(received, this.name);
  });

  #report(caller: Caller): void {
    if (this.#fraction < 1)
      caller.report({ label: "Loading the built-in motions", fraction: this.#fraction * DOWNLOAD_SHARE });
  }
}
