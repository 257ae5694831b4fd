/** The page's side: a {@link BuildClient} over a worker that ends with its work. */
import { cancelled, disposed, fault, StrutError } from "../../engine/errors";
import type { CallOptions } from "../../engine/types";
import { sendPlain } from "../plain";
import { READING_MS, Watchdog } from "../watchdog";
import type { BuildCall, BuildReply, BuildRequest, BuildResults } from "./messages";
import type {
  BuildClient,
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

/** The part of a `Worker` that the client needs. */
export interface BuildWorkerPort {
  postMessage(message: BuildRequest): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<BuildReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

/** A worker that builds handles a cancellation between two steps, which take less than this. */
const PATIENCE_MS = 10_000;

/**
 * @param spawn starts a worker; the default is `build_worker.ts` in a module worker
 * @param limitMs longest silence of a worker that has pending calls; it reads a file in one piece
 */
export function createBuildClient(
  spawn: () => BuildWorkerPort = spawnWorker,
  limitMs: number = READING_MS,
): BuildClient {
  return new WorkerBuildClient(spawn, limitMs);
}

function spawnWorker(): BuildWorkerPort {
  return new Worker(new URL("./build_worker.ts", import.meta.url), { type: "module", name: "strut build" });
}

interface Pending {
  resolve(value: BuildResults[BuildCall["method"]]): void;
  reject(error: StrutError): void;
  options: CallOptions;
  onRead: ((event: ReadEvent) => void) | undefined;
}

class WorkerBuildClient implements BuildClient {
  private worker: BuildWorkerPort | undefined;
  private readonly pending = new Map<number, Pending>();
  private lastId = 0;
  /** The files that a new worker needs to have the same clips. These are references: the browser holds the data. */
  private files: DroppedFile[] = [];
  /** Settles when it is known whether the worker survives the cancellation of a build. */
  private pausing: Promise<void> = Promise.resolve();

  private readonly watchdog: Watchdog;

  constructor(
    private readonly spawn: () => BuildWorkerPort,
    limitMs: number,
  ) {
    this.watchdog = new Watchdog({
      stepMs: Math.min(limitMs, PATIENCE_MS),
      graceMs: Math.min(limitMs, PATIENCE_MS),
      limitMs: () => limitMs,
      isWaiting: () => this.pending.size > 0,
      onSilent: () => this.stop(fault("Building failed: its worker does not answer")),
    });
  }

  async open(files: DroppedFile[], options?: CallOptions): Promise<Found> {
    this.stop(cancelled());
    this.files = files;
    return this.call({ method: "open", files }, options);
  }

  label(pattern: string | undefined, table: File | undefined): Promise<Labelled[]> {
    return this.call({ method: "label", pattern, table });
  }

  async readAll(onRead: (event: ReadEvent) => void, options?: CallOptions): Promise<void> {
    await this.call({ method: "readAll" }, options, onRead);
  }

  preview(index: number, roles: Roles | undefined): Promise<Preview> {
    return this.call({ method: "preview", index, roles });
  }

  async build(files: ChosenFile[], neutral: string | undefined, options: CallOptions = {}): Promise<BuiltDatabase> {
    await this.pausing;
    const { signal, ...others } = options;
    if (signal?.aborted) throw cancelled();
    const pause = () => {
      this.pausing = this.pause();
    };
    signal?.addEventListener("abort", pause, { once: true });
    try {
      return await this.call({ method: "build", files, neutral }, others);
    } finally {
      signal?.removeEventListener("abort", pause);
      // A module's memory never shrinks; the build's memory is freed with its worker.
      if (!signal?.aborted) this.stop(cancelled());
    }
  }

  /** Cancels the build at once. The worker keeps its results, unless it does not respond and must be replaced. */
  private async pause(): Promise<void> {
    const { worker } = this;
    for (const [id, call] of this.pending) {
      call.reject(cancelled());
      this.pending.delete(id);
    }
    let timer: ReturnType<typeof setTimeout> | undefined;
    const patience = new Promise<boolean>((resolve) => {
      timer = setTimeout(() => resolve(false), PATIENCE_MS);
    });
    const heard = this.post({ method: "pause" }, {}, undefined).then(
      () => true,
      () => true,
    );
    const paused = await Promise.race([heard, patience]);
    clearTimeout(timer);
    if (!paused && this.worker === worker) this.stop(cancelled());
  }

  async addStyle(
    database: Blob | undefined,
    clip: File,
    style: string,
    { action, ...options }: CallOptions & { action?: string | undefined } = {},
  ): Promise<BuiltDatabase> {
    try {
      return await this.call({ method: "addStyle", database, clip, style, action }, options);
    } finally {
      this.stop(cancelled());
    }
  }

  async trainWalk(database: Blob | undefined, options?: CallOptions): Promise<TrainedWalk> {
    try {
      return await this.call({ method: "trainWalk", database }, options);
    } finally {
      this.stop(cancelled());
    }
  }

  async trainKeyStyle(
    database: Blob | undefined,
    files: readonly DroppedFile[],
    order: KeyStyleOrder,
    options?: CallOptions,
  ): Promise<TrainedKeyStyle> {
    try {
      return await this.call({ method: "trainKeyStyle", database, files: [...files], order }, options);
    } finally {
      this.stop(cancelled());
    }
  }

  dispose(): void {
    this.stop(disposed("build client"));
    this.files = [];
  }

  private call<C extends BuildCall>(
    call: C,
    options: CallOptions = {},
    onRead?: (event: ReadEvent) => void,
  ): Promise<BuildResults[C["method"]]> {
    const { signal } = options;
    if (signal?.aborted) return Promise.reject(cancelled());
    // A new worker must receive the files first; it answers in order.
    if (!this.worker && call.method !== "open")
      this.post({ method: "open", files: this.files }, {}, undefined).catch(() => {});
    const cancel = () => this.stop(cancelled());
    signal?.addEventListener("abort", cancel, { once: true });
    const answer = this.post(call, options, onRead);
    return answer.finally(() => signal?.removeEventListener("abort", cancel)) as Promise<BuildResults[C["method"]]>;
  }

  private post(
    call: BuildCall,
    options: CallOptions,
    onRead: ((event: ReadEvent) => void) | undefined,
  ): Promise<BuildResults[BuildCall["method"]]> {
    this.worker ??= this.start();
    const { worker } = this;
    const id = ++this.lastId;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject, options, onRead });
      this.watchdog.restart();
      try {
        sendPlain({ ...call, id }, (message) => worker.postMessage(message));
      } catch (thrown) {
        this.pending.delete(id);
        reject(thrown);
      }
    });
  }

  private start(): BuildWorkerPort {
    const worker = this.spawn();
    let started = false;
    worker.onmessage = ({ data }) => {
      started = true;
      if (this.worker === worker) this.receive(data);
    };
    worker.onerror = ({ message }) => {
      if (this.worker === worker) this.stop(started ? fault(`Building failed: ${message}`) : unloadable(message));
    };
    return worker;
  }

  private receive(reply: BuildReply): void {
    this.watchdog.restart();
    const call = this.pending.get(reply.id);
    if (!call) return;
    if (reply.kind === "progress") call.options.onProgress?.(reply.progress);
    else if (reply.kind === "read") call.onRead?.(reply.event);
    else {
      this.pending.delete(reply.id);
      if (reply.kind === "result") call.resolve(reply.value);
      else {
        const error = new StrutError(reply.error);
        call.reject(error);
        // The instance that failed takes no more calls.
        if (error.code === "fault") this.stop(error);
      }
    }
  }

  /** Terminates the worker and rejects all unanswered calls. */
  private stop(error: StrutError): void {
    this.watchdog.stop();
    this.worker?.terminate();
    this.worker = undefined;
    for (const call of this.pending.values()) call.reject(error);
    this.pending.clear();
  }
}

/** The error of a worker that never sent a message. @param why the reason, empty if the browser does not report it */
function unloadable(why: string): StrutError {
  return new StrutError({
    code: "load",
    message: `The database builder could not be started: ${why || "build_worker.js could not be loaded"}.`,
    hint: "Reload the page; if that does not help, the site was not deployed completely.",
  });
}
