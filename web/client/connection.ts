/**
 * A worker as the client sees it: calls with cancellation and progress. After a fault, another worker replaces it, and
 * everything that was open is opened again under the same ids.
 */
import { disposed, StrutError } from "../engine/errors";
import type { Arguments, Id, Method, Result, WorkerCalls } from "./messages";
import type { CallOptions, OpenMemory } from "./protocol";
import { abortable, RemoteWorker, type WorkerPort } from "./rpc";
import { READING_MS } from "./watchdog";

/** Time limits for a silent worker. */
export interface Patience {
  /** A worker with pending calls that sends nothing for this time is sent a ping; milliseconds. */
  silenceMs: number;
  /** A worker that does not answer a ping within this time is replaced; milliseconds. */
  pingMs: number;
  /** Longest silence of a worker that reads a file in one piece; milliseconds, ten minutes by default. */
  readingMs?: number;
}

export const DEFAULT_PATIENCE: Patience = { silenceMs: 20_000, pingMs: 5000 };

/** Makes a call without waiting until everything is reopened. */
export type Post = <M extends Method>(method: M, args: Arguments<M>) => Promise<Result<M>>;

/** An open object in the worker that the connection can reopen. */
export interface Reopenable {
  readonly id: Id;
  /** Why it takes no more calls; `undefined` while it is open. */
  readonly closed: StrutError | undefined;
  /** Its memory. */
  readonly memory: OpenMemory;
  /** Opens it in a new worker under the same id. */
  reopen(post: Post): Promise<unknown>;
  /** Closes it permanently. */
  lose(reason: StrutError): void;
}

/** Result of reopening everything after a failed worker was replaced. */
interface Restart {
  /** The fault, a sentence for the user. */
  message: string;
  /** Objects that could not be reopened, and the reasons. */
  lost: { thing: Reopenable; reason: string }[];
}

/** What the connection must know of a call. */
interface Traits {
  /** The worker may be silent: it reads a file in one piece. The others work in time slices. */
  silent?: true;
  /** It opens something under the id in its first argument. */
  opens?: true;
  /** Its result shows that the engine works with what is open. */
  proves?: true;
}

const TRAITS: Partial<Readonly<Record<Method, Traits>>> = {
  openDatabase: { silent: true, opens: true },
  openMotion: { silent: true, opens: true },
  createSession: { silent: true, opens: true },
  createStylizer: { opens: true },
  openDrive: { opens: true },
  openAtlas: { opens: true },
  builtInInputs: { silent: true },
  readMotion: { silent: true },
  motionOn: { silent: true },
  counterpart: { silent: true, proves: true },
  exportBvh: { silent: true, proves: true },
  step: { proves: true },
  seek: { proves: true },
  analyse: { proves: true },
  examples: { proves: true },
  stylize: { proves: true },
  compareSearch: { proves: true },
  push: { proves: true },
  drive: { proves: true },
};

export class Connection {
  onRestart: ((restart: Restart) => void) | undefined;
  private worker: RemoteWorker<WorkerCalls> | undefined;
  /** Settles when the worker is loaded and everything is reopened; `undefined` if it must be started first. */
  private running: Promise<void> | undefined;
  private disposed = false;
  private lastId = 0;
  /** In the order of opening, so that every object comes after those it was made from. */
  private readonly open = new Set<Reopenable>();
  /** Whether the current worker has styled anything. If not, reopening the same objects would probably fail again. */
  private proven = true;
  /** Argument of `onRestart`, called once the new worker is ready. */
  private restart: Restart | undefined;

  constructor(
    private readonly spawn: () => WorkerPort,
    private readonly patience: Patience,
  ) {}

  /**
   * Resolves when the worker takes calls. If a worker could not be started, another attempt is made.
   * @throws StrutError `load`, `unsupported` or `disposed`
   */
  ready(): Promise<void> {
    if (this.disposed) return Promise.reject(disposed("client"));
    this.running ??= this.start();
    return this.running;
  }

  /** A new id for an object to be opened. */
  nextId(): Id {
    this.lastId += 1;
    return this.lastId;
  }

  /** Registers an object to be reopened after a fault. */
  keep(thing: Reopenable): void {
    this.open.add(thing);
  }

  /** Memory of all open objects. */
  memory(): OpenMemory[] {
    return [...this.open].filter(({ closed }) => !closed).map(({ memory }) => memory);
  }

  /** Closes a disposed object and those made from it. */
  forget(thing: Reopenable): void {
    for (const kept of this.open) if (kept.closed) this.open.delete(kept);
    // Without a worker there is nothing to close.
    if (this.running && !this.disposed) void this.call("close", [thing.id]).catch(() => {});
  }

  async call<M extends Method>(method: M, args: Arguments<M>, options: CallOptions = {}): Promise<Result<M>> {
    const { opens, proves } = TRAITS[method] ?? {};
    const worker = await abortable(options.signal, () => this.current());
    const onLate = () => opens && void this.call("close", [args[0] as Id]).catch(() => {});
    const result = await worker.call(method, args, { ...options, onLate });
    this.proven ||= proves ?? false;
    return result;
  }

  /** Resolves when no call is in progress. */
  async idle(): Promise<void> {
    await this.worker?.idle();
  }

  /** Terminates the worker and rejects every call. */
  dispose(): void {
    this.disposed = true;
    const error = disposed("client");
    this.worker?.end(error);
    for (const thing of this.open) thing.lose(error);
    this.open.clear();
  }

  /** The worker, once it takes calls. */
  private async current(): Promise<RemoteWorker<WorkerCalls>> {
    for (;;) {
      const running = this.ready();
      await running;
      // A worker may have failed, or been terminated, between its start and this moment.
      if (running === this.running && !this.disposed) return this.worker!;
    }
  }

  private start(): Promise<void> {
    const running = this.load().then((worker) => this.reopenAll(worker));
    running.catch(() => {
      if (this.running === running) this.running = undefined;
    });
    return running;
  }

  /** Starts a worker and resolves when its engine is loaded. */
  private async load(): Promise<RemoteWorker<WorkerCalls>> {
    const { silenceMs, pingMs, readingMs = READING_MS } = this.patience;
    let isLoaded = false;
    const worker = new RemoteWorker<WorkerCalls>(this.spawn(), {
      what: "engine",
      silenceMs,
      graceMs: pingMs,
      pings: true,
      limitMs: (methods) => (methods.some((method) => TRAITS[method as Method]?.silent) ? readingMs : silenceMs),
      onFail: (error) => isLoaded && this.replace(error),
    });
    this.worker = worker;
    await worker.ready.catch((error: StrutError) => {
      throw notReady(error);
    });
    isLoaded = true;
    return worker;
  }

  /** Reopens in a new worker everything that was open in the previous one. */
  private async reopenAll(worker: RemoteWorker<WorkerCalls>): Promise<void> {
    for (const thing of this.open) {
      if (this.worker !== worker) return this.ready();
      try {
        if (!thing.closed) await thing.reopen((method, args) => worker.call(method, args));
        if (thing.closed) this.open.delete(thing);
      } catch (thrown) {
        if (this.worker !== worker) return this.ready();
        this.lose(thing, (thrown as StrutError).message);
      }
    }
    if (this.worker !== worker) return this.ready();
    const { restart } = this;
    this.restart = undefined;
    if (restart) this.onRestart?.(restart);
  }

  private lose(thing: Reopenable, reason: string): void {
    thing.lose(new StrutError({ code: "not-open", message: reason, hint: "Open it again." }));
    this.open.delete(thing);
    this.restart?.lost.push({ thing, reason });
  }

  /** Replaces a failed worker. */
  private replace(error: StrutError): void {
    this.restart ??= { message: error.message, lost: [] };
    if (!this.proven) for (const thing of this.open) this.lose(thing, "It failed twice in a row.");
    this.proven = false;
    this.running = this.start();
  }
}

/** The error of an engine that could not be loaded. It is not a bug: the browser refuses the code. */
function notReady(error: StrutError): StrutError {
  if (error.code !== "fault") return error;
  return new StrutError({
    code: "load",
    message: "The engine could not be started, because the browser blocked its code.",
    hint: `Reload the page; if that does not help, allow WebAssembly on this site, or use another browser. (${error.message})`,
  });
}
