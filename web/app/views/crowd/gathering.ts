/** Gathers a crowd: its model is trained unless it is known, and of several requests the last one is met. */

import { type Crowd, type CrowdStart, createCrowd } from "../../../client/crowd/crowd_client";
import type { FieldVertex } from "../../../client/crowd/limits";
import { type CallOptions, isCancellation } from "../../../client/protocol";
import { drawnBones } from "../../../viewer/crowd/crowd_viewer";
import { strings } from "../../strings/strings";
import type { ProgressLine } from "../../ui/progress";
import { errorText } from "../../ui/words";
import type { WalkModels, WalkSource } from "../synthesis/walk_models";

const words = strings.crowd;

/** What is gathered, or was. */
export interface Gathered {
  source: WalkSource;
  seed: number;
}

export interface GatheringListeners {
  /** What a crowd begins with. */
  start: () => CrowdStart;
  /** Chooses the field, among the styles of the model. */
  fieldOf: (styles: readonly string[], source: WalkSource) => readonly FieldVertex[];
  onReady: (crowd: Crowd) => void;
  /** There is no crowd; why, or nothing where the person cancelled it. */
  onFailed: (source: WalkSource, why: string) => void;
}

export class Gathering {
  /** Models of databases other than the built-in one, whose walks need no training. */
  #models: WalkModels | undefined;
  readonly #progress: ProgressLine;
  readonly #listeners: GatheringListeners;
  #gathered: Gathered | undefined;
  #opening: AbortController | undefined;

  constructor(progress: ProgressLine, listeners: GatheringListeners) {
    this.#progress = progress;
    this.#listeners = listeners;
  }

  /** What was asked for last; `undefined` where it failed or was given up. */
  get gathered(): Gathered | undefined {
    return this.#gathered;
  }

  /** Gathers people by the model of a database. */
  async open(source: WalkSource): Promise<void> {
    this.#opening?.abort();
    const opening = new AbortController();
    this.#opening = opening;
    const start = this.#listeners.start();
    this.#gathered = { source, seed: start.seed ?? 1 };
    try {
      const label = source.file ? words.training : words.opening;
      const crowd = await this.#progress.run(label, (call) => this.#create(source, start, call));
      if (opening.signal.aborted) crowd.dispose();
      else this.#listeners.onReady(crowd);
    } catch (error) {
      if (opening.signal.aborted) return;
      this.#gathered = undefined;
      this.#listeners.onFailed(source, isCancellation(error) ? "" : errorText(error));
    }
  }

  /** Gives up what is being gathered, and forgets what was. */
  cancel(): void {
    this.#opening?.abort();
    this.#progress.cancel();
    this.#gathered = undefined;
  }

  async #create(source: WalkSource, start: CrowdStart, { signal, ...call }: CallOptions): Promise<Crowd> {
    const options = { ...call, ...(signal && { signal }) };
    const model = source.file && (await this.#modelOf(source, options));
    signal?.throwIfAborted();
    const fieldOf = (styles: readonly string[]) => this.#listeners.fieldOf(styles, source);
    return createCrowd(
      { kind: "walkers", ...(model && { model }) },
      { ...start, fieldOf, bonesOf: drawnBones, ...(signal && { signal }) },
    );
  }

  async #modelOf(source: WalkSource, options: CallOptions): Promise<Uint8Array> {
    const { WalkModels } = await import("../synthesis/walk_models");
    this.#models ??= new WalkModels();
    return (await this.#models.of(source, options)).trained.file;
  }
}
