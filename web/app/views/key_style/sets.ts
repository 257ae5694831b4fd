/** Training motions: clips of the built-in database, of the open one, or dropped files. */
import type { DroppedFile, KeyStyleOrder, TrainedKeyStyle } from "../../../client/build/protocol";
import { trainKeyStyle } from "../../../client/models/key_style";
import type { CallOptions } from "../../../client/protocol";

/** A set of motions as in the state: an action of the built-in database, `open` with or without one, or `files`. */
interface MotionSet {
  source: "built-in" | "open" | "files";
  action: string;
}

/** Actions of the built-in database that can be selected directly. */
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

/** Training data and settings of a model. */
export interface ModelRequest {
  source: ClipSource;
  order: KeyStyleOrder;
}

/**
 * Whether two requests are for the same model. A database that was built again under its name is another file, and so
 * are files that were dropped again.
 */
export function isSameRequest(a: ModelRequest, b: ModelRequest): boolean {
  return (
    a.source.database === b.source.database &&
    a.source.files === b.source.files &&
    JSON.stringify(a.order) === JSON.stringify(b.order)
  );
}

/** Maximum number of models that are kept, so that switching between variables needs no training. */
const MAX_KEPT = 12;

/** Models that were trained on this page, the least recently used first. */
export class KeyStyleModels {
  #trained: { request: ModelRequest; trained: TrainedKeyStyle }[] = [];

  /** The model of a request, trained unless it is known. */
  async of(request: ModelRequest, options: CallOptions): Promise<TrainedKeyStyle> {
    const known = this.#trained.find((entry) => isSameRequest(entry.request, request));
    const { database, files } = request.source;
    const trained = known?.trained ?? (await trainKeyStyle(files ? { files } : { database }, request.order, options));
    const others = this.#trained.filter((entry) => !isSameRequest(entry.request, request));
    this.#trained = [...others, { request, trained }].slice(-MAX_KEPT);
    return trained;
  }
}
