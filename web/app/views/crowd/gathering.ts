/**
 * Creates a crowd: its model is trained, or its motion is recorded, unless they are known. Of several requests only the
 * last one counts.
 */

import { type Crowd, type CrowdStart, createCrowd } from "../../../client/crowd/crowd_client";
import type { FieldVertex, People } from "../../../client/crowd/limits";
import { type CallOptions, isCancellation, type RecordedMotion } from "../../../client/protocol";
import { drawnBones } from "../../../viewer/crowd/crowd_viewer";
import { strings } from "../../strings/strings";
import type { ProgressLine } from "../../ui/progress";
import { errorText } from "../../ui/words";
import type { WalkModels, WalkSource } from "../synthesis/walk_models";

const words = strings.crowd;

/** The crowd that is being created, or was created. */
interface Gathered {
  source: WalkSource;
  seed: number;
  /** {@link Performance.key}; empty for walkers. */
  performs: string;
}

/** The motion to perform. */
export interface Performance {
  /** Motions with different keys differ. */
  key: string;
  record(call: CallOptions): Promise<RecordedMotion>;
}

interface GatheringListeners {
  /** Initial settings of the crowd. */
  start: () => CrowdStart;
  /** The motion to perform; `undefined` for walkers. */
  performance: () => Performance | undefined;
  /** Chooses the field from the styles of the model. */
  fieldOf: (styles: readonly string[], source: WalkSource) => readonly FieldVertex[];
  /** Called when the crowd is ready; `performs` is the motion it performs. */
  onReady: (crowd: Crowd, performs: RecordedMotion | undefined) => void;
  /** Called when there is no crowd, with the reason, which is empty if the user cancelled. */
  onFailed: (source: WalkSource, why: string) => void;
}

export class Gathering {
  /** Models of databases other than the built-in one, whose model needs no training. */
  #models: WalkModels | undefined;
  /** The last recording. */
  #recorded: { source: WalkSource; key: string; motion: RecordedMotion } | undefined;
  readonly #progress: ProgressLine;
  readonly #listeners: GatheringListeners;
  #gathered: Gathered | undefined;
  #asked: Gathered | undefined;
  #opening: AbortController | undefined;

  constructor(progress: ProgressLine, listeners: GatheringListeners) {
    this.#progress = progress;
    this.#listeners = listeners;
  }

  /** The last request; `undefined` if it failed or was cancelled. */
  get gathered(): Gathered | undefined {
    return this.#gathered;
  }

  /** The last request, even if it failed or was cancelled. */
  get asked(): Gathered | undefined {
    return this.#asked;
  }

  /** Creates a crowd by the model of a database. */
  async open(source: WalkSource): Promise<void> {
    this.#opening?.abort();
    const opening = new AbortController();
    this.#opening = opening;
    const start = this.#listeners.start();
    const performance = this.#listeners.performance();
    this.#gathered = { source, seed: start.seed ?? 1, performs: performance?.key ?? "" };
    this.#asked = this.#gathered;
    try {
      const label = performance ? words.recording : source.file ? words.training : words.opening;
      const [crowd, performs] = await this.#progress.run(label, async (call) => {
        const motion = performance && (await this.#record(source, performance, call));
        return [await this.#create(source, motion, start, call), motion] as const;
      });
      if (opening.signal.aborted) crowd.dispose();
      else this.#listeners.onReady(crowd, performs);
    } catch (error) {
      if (opening.signal.aborted) return;
      this.#gathered = undefined;
      this.#listeners.onFailed(source, isCancellation(error) ? "" : errorText(error));
    }
  }

  /** Cancels the current request, and forgets the last one. */
  cancel(): void {
    this.#opening?.abort();
    this.#progress.cancel();
    this.#gathered = undefined;
    this.#asked = undefined;
  }

  async #create(
    source: WalkSource,
    recorded: RecordedMotion | undefined,
    start: CrowdStart,
    { signal, ...call }: CallOptions,
  ): Promise<Crowd> {
    const options = { ...call, ...(signal && { signal }) };
    const people: People = recorded ? { kind: "performers", recorded } : await this.#walkers(source, options);
    signal?.throwIfAborted();
    const fieldOf = (styles: readonly string[]) => this.#listeners.fieldOf(styles, source);
    return createCrowd(people, { ...start, fieldOf, bonesOf: drawnBones, ...(signal && { signal }) });
  }

  async #record(source: WalkSource, { key, record }: Performance, call: CallOptions): Promise<RecordedMotion> {
    const known = this.#recorded;
    if (known?.key === key && known.source.file === source.file) return known.motion;
    this.#recorded = undefined;
    const motion = await record(call);
    this.#recorded = { source, key, motion };
    return motion;
  }

  async #walkers(source: WalkSource, options: CallOptions): Promise<People> {
    return source.file ? { kind: "walkers", model: await this.#modelOf(source.file, options) } : { kind: "walkers" };
  }

  async #modelOf(file: Blob, options: CallOptions): Promise<Uint8Array> {
    const { WalkModels } = await import("../synthesis/walk_models");
    this.#models ??= new WalkModels();
    return (await this.#models.of(file, options)).trained.file;
  }
}
