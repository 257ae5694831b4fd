/** Walk models of databases: trained once, then kept as long as the page is open. */
import { createBuildClient } from "../../worker/build/client";
import type { TrainedWalk } from "../../worker/build/protocol";
import type { CallOptions } from "../../worker/protocol";

/** A database to train on; without a file the built-in one. */
export interface WalkSource {
  name: string;
  file: Blob | undefined;
}

/** A model with how it came about. */
export interface Trained extends TrainedWalk {
  secs: number;
}

export class WalkModels {
  readonly #builtIn = { made: undefined as Trained | undefined };
  readonly #made = new WeakMap<Blob, Trained>();

  /** The model of a database; `fresh` says whether it was trained just now. */
  async of({ file }: WalkSource, options: CallOptions): Promise<{ trained: Trained; fresh: boolean }> {
    const known = file ? this.#made.get(file) : this.#builtIn.made;
    if (known) return { trained: known, fresh: false };
    const client = createBuildClient();
    const begin = performance.now();
    try {
      const trained = { ...(await client.trainWalk(file, options)), secs: (performance.now() - begin) / 1000 };
      if (file) this.#made.set(file, trained);
      else this.#builtIn.made = trained;
      return { trained, fresh: true };
    } finally {
      client.dispose();
    }
  }
}
