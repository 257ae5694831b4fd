/** The page's side of building: a worker that ends with its work. */
import { cancelled, disposed } from "../../engine/errors";
import type { CallOptions, Progress } from "../../engine/types";
import { type ArgumentsOf, abortable, type RemoteCallOptions, type ResultOf, type WorkerPort } from "../rpc";
import { RpcClient } from "../rpc_client";
import type {
  BuildCalls,
  BuiltDatabase,
  ChosenFile,
  DroppedFile,
  Found,
  KeyStyleOrder,
  Labelled,
  Preview,
  ReadEvent,
  Roles,
  TrainedKeyStyle,
  TrainedWalk,
} from "./protocol";

/** A worker that builds handles a cancellation between two steps, which take less than this. */
const PATIENCE_MS = 10_000;

function spawnWorker(): WorkerPort {
  return new Worker(new URL("./build_worker.ts", import.meta.url), { type: "module", name: "strut build" });
}

/**
 * Builds databases and trains models. One set of files is open at a time. Rejections are `StrutError`s whose messages
 * are sentences for the user. Cancelling a call ends the worker, whatever it is doing, and a new one replaces it. Only a
 * build is paused instead: until other files are opened, the same build continues from there.
 */
export class BuildClient {
  /** The files that a new worker needs to have the same clips. These are references: the browser holds the data. */
  private files: DroppedFile[] = [];
  /** Settles when it is known whether the worker survives the cancellation of a build. */
  private pausing: Promise<void> = Promise.resolve();

  private readonly rpc: RpcClient<BuildCalls>;

  /**
   * @param spawn starts a worker; the default is `build_worker.ts` in a module worker
   * @param limitMs longest silence of a worker that has pending calls; it reads a file in one piece
   */
  constructor(spawn: () => WorkerPort = spawnWorker, limitMs?: number) {
    this.rpc = new RpcClient(spawn, "database builder", limitMs, "build_worker.js");
  }

  /** Lists the clips among these files, which replace the previous ones. Nothing is unpacked yet. */
  async open(files: DroppedFile[], options?: CallOptions): Promise<Found> {
    this.end();
    this.files = files;
    return this.call("open", [files], options);
  }

  /** Labels of every clip, in order, from the table or, without one, from the pattern. */
  label(pattern: string | undefined, table: File | undefined): Promise<Labelled[]> {
    return this.call("label", [pattern, table]);
  }

  /** Reads every clip once to find its length, frame rate and skeleton. */
  async readAll(onRead: (event: ReadEvent) => void, { signal, onProgress }: CallOptions = {}): Promise<void> {
    const report = (progress: Progress) => {
      onRead(progress as Progress & ReadEvent);
      onProgress?.(progress);
    };
    await this.call("readAll", [], { signal, onProgress: report });
  }

  /** The poses of a clip, by its index, and its skeleton, with these roles or those that are found. */
  preview(index: number, roles: Roles | undefined): Promise<Preview> {
    return this.call("preview", [index, roles]);
  }

  /** Builds a database. Without `neutral`, the neutral style is found by its name. */
  async build(files: ChosenFile[], neutral: string | undefined, options: CallOptions = {}): Promise<BuiltDatabase> {
    await this.pausing;
    const pause = () => {
      this.pausing = this.paused();
    };
    try {
      return await abortable(options.signal, () => this.post("build", [files, neutral], options), pause);
    } finally {
      // A module's memory never shrinks; the build's memory is freed with its worker.
      if (!options.signal?.aborted) this.end();
    }
  }

  /** Adds a clip as a new style to a database, or to the built-in one. Without `action`, the action that fits best is used. */
  addStyle(
    database: Blob | undefined,
    clip: File,
    style: string,
    { action, ...options }: CallOptions & { action?: string | undefined } = {},
  ): Promise<BuiltDatabase> {
    return this.call("addStyle", [database, clip, style, action], options).finally(() => this.end());
  }

  /** Trains a walk model on a database, or on the built-in one. */
  trainWalk(database: Blob | undefined, options?: CallOptions): Promise<TrainedWalk> {
    return this.call("trainWalk", [database], options).finally(() => this.end());
  }

  /** Trains a key-style model on clips of the files; without files on a database, or on the built-in one. */
  trainKeyStyle(
    database: Blob | undefined,
    files: readonly DroppedFile[],
    order: KeyStyleOrder,
    options?: CallOptions,
  ): Promise<TrainedKeyStyle> {
    return this.call("trainKeyStyle", [database, [...files], order], options).finally(() => this.end());
  }

  /** Ends the worker and forgets the files. Other files may be opened afterwards. */
  dispose(): void {
    this.end(disposed("database builder"));
    this.files = [];
  }

  /** Makes a call whose cancellation ends the worker. */
  private call<M extends keyof BuildCalls>(
    method: M,
    args: ArgumentsOf<BuildCalls, M>,
    { signal, onProgress }: RemoteCallOptions = {},
  ): Promise<ResultOf<BuildCalls, M>> {
    return abortable(
      signal,
      () => this.post(method, args, { onProgress }),
      () => this.end(),
    );
  }

  private post<M extends keyof BuildCalls>(
    method: M,
    args: ArgumentsOf<BuildCalls, M>,
    options: RemoteCallOptions,
  ): Promise<ResultOf<BuildCalls, M>> {
    // A new worker must receive the files first; it answers in order.
    if (!this.rpc.isRunning && method !== "open") this.rpc.call("open", [this.files]).catch(() => {});
    return this.rpc.call(method, args, options);
  }

  /** Waits until the cancelled build is paused. Ends a worker that does not respond. */
  private async paused(): Promise<void> {
    const timer = setTimeout(() => this.end(), PATIENCE_MS);
    await this.rpc.idle();
    clearTimeout(timer);
  }

  private end(reason = cancelled()): void {
    this.rpc.stop(reason);
  }
}
