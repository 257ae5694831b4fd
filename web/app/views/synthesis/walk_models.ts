/**
 * Walk models of databases: trained once, then kept as long as the page is open. That of the built-in database comes with
 * the page.
 */
import type { TrainedWalk } from "../../../client/build/protocol";
import { trainWalk } from "../../../client/models/walk";
import type { CallOptions } from "../../../client/protocol";

/** A database whose walk model is used. */
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
  readonly #trained = new WeakMap<Blob, TimedWalk>();

  /** The model of a database, by its file; `fresh` tells whether it was trained just now. */
  async of(file: Blob, options: CallOptions): Promise<{ trained: TimedWalk; fresh: boolean }> {
    const known = this.#trained.get(file);
    if (known) return { trained: known, fresh: false };
    const begin = performance.now();
    const trained = { ...(await trainWalk(file, options)), secs: (performance.now() - begin) / 1000 };
    this.#trained.set(file, trained);
    return { trained, fresh: true };
  }
}
