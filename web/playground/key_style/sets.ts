/** What is learned from: clips of the built-in database, of the one that is open, or files that were dropped. */
import { createBuildClient } from "../../worker/build/client";
import type { DroppedFile, KeyStyleOrder, TrainedKeyStyle } from "../../worker/build/protocol";
import type { CallOptions } from "../../worker/protocol";

/** A set of motions, as the state has it: an action of the built-in database, `open` with or without one, or `files`. */
export interface MotionSet {
  source: "built-in" | "open" | "files";
  action: string;
}

/** Actions of the built-in database that are one click away. */
export const BUILT_IN_SETS = ["walk", "punch", "run"] as const;

export function parseSet(text: string): MotionSet {
  if (text === "files") return { source: "files", action: "" };
  const [source, action] = text.split("/", 2);
  return source === "open" ? { source: "open", action: action ?? "" } : { source: "built-in", action: text };
}

/** Where the clips of a set are: without either, in the built-in database. */
export interface ClipSource {
  database?: Blob;
  files?: readonly DroppedFile[];
}

/** Most models that are kept: going back and forth between variables is then free. */
const MOST_KEPT = 12;

/** Models that were trained on this page. */
export class KeyStyleModels {
  readonly #made = new Map<string, TrainedKeyStyle>();
  readonly #names = new WeakMap<object, number>();
  #sources = 0;

  /** The model of an order; `fresh` says whether it was trained just now. */
  async of(source: ClipSource, order: KeyStyleOrder, options: CallOptions): Promise<TrainedKeyStyle> {
    const key = JSON.stringify([this.#nameOf(source.database ?? source.files), order]);
    const known = this.#made.get(key);
    if (known) return known;
    const client = createBuildClient();
    try {
      const trained = await client.trainKeyStyle(source.database, source.files ?? [], order, options);
      this.#made.set(key, trained);
      const [oldest] = this.#made.keys();
      if (this.#made.size > MOST_KEPT && oldest !== undefined) this.#made.delete(oldest);
      return trained;
    } finally {
      client.dispose();
    }
  }

  #nameOf(source: object | undefined): number {
    if (!source) return 0;
    const known = this.#names.get(source) ?? ++this.#sources;
    this.#names.set(source, known);
    return known;
  }
}
