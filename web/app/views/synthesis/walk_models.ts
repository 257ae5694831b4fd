/** Walk models of databases: trained once, then kept as long as the page is open. */
import type { TrainedWalk } from "../../../client/build/protocol";
import { trainWalk } from "../../../client/models/walk";
import type { CallOptions } from "../../../client/protocol";

/** A database to train a model on. */
export interface WalkSource {
  /** Its display name. */
  name: string;
  /** Its file; `undefined` for the built-in database. A database that was built again is another file. */
  file: Blob | undefined;
  /** Its neutral style. */
  neutral: string;
}

/** A model and the duration of its training. */
interface TimedWalk extends TrainedWalk {
  secs: number;
}

export class WalkModels {
  #builtIn: TimedWalk | undefined;
  readonly #trained = new WeakMap<Blob, TimedWalk>();

  /** The model of a database; `fresh` tells whether it was trained just now. */
  async of({ file }: WalkSource, options: CallOptions): Promise<{ trained: TimedWalk; fresh: boolean }> {
    const known = file ? this.#trained.get(file) : this.#builtIn;
    if (known) return { trained: known, fresh: false };
    const begin = performance.now();
    const trained = { ...(await trainWalk(file, options)), secs: (performance.now() - begin) / 1000 };
    if (file) this.#trained.set(file, trained);
    else this.#builtIn = trained;
    return { trained, fresh: true };
  }
}
