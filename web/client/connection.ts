/**
 * A worker as the client sees it: calls with cancellation and progress. After a fault, another worker replaces it, and
 * everything that was open is opened again under the same ids.
 */
import { cancelled, disposed, type ErrorParts, fault, StrutError, toStrutError } from "../engine/errors";
import type { Arguments, Call, Id, Method, Reply, Request, Result } from "./messages";
import { sendPlain } from "./plain";
import type { CallOptions, OpenMemory, Progress } from "./protocol";
import { READING_MS, Watchdog } from "./watchdog";

/** The part of a `Worker` that the connection needs. */
export interface WorkerPort {
  postMessage(message: Request): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Reply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

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

interface Pending {
  method: Method;
  /** Id of the object that the call opens. */
  opens: Id | undefined;
  /** Whether its caller has cancelled it and no longer waits. */
  abandoned: boolean;
  resolve(value: Result<Method>): void;
  reject(error: StrutError): void;
  onProgress: ((progress: Progress) => void) | undefined;
}

export class Connection {
  onRestart: ((restart: Restart) => void) | undefined;
  private worker: WorkerPort | undefined;
  /** Settles when the worker is loaded and everything is reopened; `undefined` if it must be started first. */
  private running: Promise<void> | undefined;
  private disposed = false;
  private readonly pending = new Map<number, Pending>();
  private whenIdle: (() => void)[] = [];
  private lastCall = 0;
  private lastId = 0;
  /** In the order of opening, so that every object comes after those it was made from. */
  private readonly open = new Set<Reopenable>();
  /** Whether the current worker has styled anything. If not, reopening the same objects would probably fail again. */
  private proven = true;
  /** Argument of `onRestart`, called once the new worker is ready. */
  private restart: Restart | undefined;
  private readonly watchdog: Watchdog;
  /** Rejects the wait for a worker that is loading. */
  private failStart: (error: StrutError) => void = () => {};

  constructor(
    private readonly spawn: () => WorkerPort,
    { silenceMs, pingMs, readingMs = READING_MS }: Patience,
  ) {
    this.watchdog = new Watchdog({
      stepMs: silenceMs,
      graceMs: pingMs,
      limitMs: () => ([...this.pending.values()].some(({ method }) => TRAITS[method]?.silent) ? readingMs : silenceMs),
      isWaiting: () => this.pending.size > 0,
      ping: () => this.worker?.postMessage({ kind: "ping" }),
      onSilent: () => this.replace(fault("The engine failed: its worker does not answer")),
    });
  }

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

  call<M extends Method>(method: M, args: Arguments<M>, options: CallOptions = {}): Promise<Result<M>> {
    const { signal, onProgress } = options;
    if (signal?.aborted) return Promise.reject(cancelled(signal.reason));
    const id = ++this.lastCall;
    let cancel = () => {};
    const answer = new Promise<Result<Method>>((resolve, reject) => {
      const opens = TRAITS[method]?.opens ? (args[0] as Id) : undefined;
      const call: Pending = { method, opens, abandoned: false, resolve, reject, onProgress };
      cancel = () => {
        call.abandoned = true;
        reject(cancelled(signal?.reason));
        if (this.pending.has(id)) this.worker?.postMessage({ kind: "cancel", id });
      };
      this.whenReady(() => !call.abandoned && this.post(id, call, args as Arguments<Method>), reject);
    });
    signal?.addEventListener("abort", cancel, { once: true });
    return answer.finally(() => signal?.removeEventListener("abort", cancel)) as Promise<Result<M>>;
  }

  /** Resolves when no call is in progress. */
  idle(): Promise<void> {
    return this.pending.size === 0 ? Promise.resolve() : new Promise((resolve) => this.whenIdle.push(resolve));
  }

  /** Terminates the worker and rejects every call. */
  dispose(): void {
    this.disposed = true;
    const error = disposed("client");
    this.stop(error);
    for (const thing of this.open) thing.lose(error);
    this.open.clear();
  }

  private whenReady(act: () => void, reject: (error: StrutError) => void): void {
    const running = this.ready();
    // A worker may have failed, or been terminated, between its start and this callback.
    const goesOn = () => running === this.running && !this.disposed;
    running.then(() => (goesOn() ? act() : this.whenReady(act, reject)), reject);
  }

  private post(id: number, call: Pending, args: Arguments<Method>): void {
    this.pending.set(id, call);
    this.watchdog.restart();
    try {
      sendPlain({ kind: "call", id, method: call.method, args } as Call, (message) =>
        this.worker!.postMessage(message),
      );
    } catch (thrown) {
      this.pending.delete(id);
      call.reject(toStrutError(thrown));
      this.tellIdle();
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
  private load(): Promise<WorkerPort> {
    return new Promise((resolve, reject) => {
      const worker = this.spawn();
      this.worker = worker;
      this.failStart = reject;
      let loaded = false;
      worker.onmessage = ({ data }) => {
        if (this.worker !== worker) return;
        if (data.kind === "ready") {
          loaded = true;
          resolve(worker);
        } else if (data.kind === "not-ready") this.stop(notReady(data.error));
        else this.receive(data);
      };
      worker.onerror = (event) => {
        if (this.worker !== worker) return;
        if (loaded) this.replace(fault(`The engine failed: ${event.message || "its worker stopped"}`));
        else this.stop(unloadable(event.message));
      };
    });
  }

  /** Reopens in a new worker everything that was open in the previous one. */
  private async reopenAll(worker: WorkerPort): Promise<void> {
    for (const thing of this.open) {
      if (this.worker !== worker) return this.ready();
      try {
        if (!thing.closed) await thing.reopen((method, args) => this.postNow(method, args));
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

  private postNow<M extends Method>(method: M, args: Arguments<M>): Promise<Result<M>> {
    return new Promise<Result<Method>>((resolve, reject) => {
      // Reopening an object does not show that the engine works with it.
      const call: Pending = { method, opens: undefined, abandoned: false, resolve, reject, onProgress: undefined };
      this.post(++this.lastCall, call, args);
    }) as Promise<Result<M>>;
  }

  private lose(thing: Reopenable, reason: string): void {
    thing.lose(new StrutError({ code: "not-open", message: reason, hint: "Open it again." }));
    this.open.delete(thing);
    this.restart?.lost.push({ thing, reason });
  }

  private receive(reply: Exclude<Reply, { kind: "ready" } | { kind: "not-ready" }>): void {
    this.watchdog.restart();
    if (reply.kind === "pong") return;
    const call = this.pending.get(reply.id);
    if (!call) return;
    if (reply.kind === "progress") {
      if (!call.abandoned) call.onProgress?.(reply.progress);
      return;
    }
    this.pending.delete(reply.id);
    if (reply.kind === "result") {
      this.proven ||= TRAITS[call.method]?.proves ?? false;
      if (call.abandoned && call.opens !== undefined) void this.call("close", [call.opens]).catch(() => {});
      call.resolve(reply.value);
    } else {
      const error = new StrutError(reply.error);
      call.reject(error);
      if (error.code === "fault") this.replace(error);
    }
    this.tellIdle();
  }

  private tellIdle(): void {
    if (this.pending.size === 0) for (const resolve of this.whenIdle.splice(0)) resolve();
  }

  /** Terminates the worker and rejects all unanswered calls. */
  private stop(error: StrutError): void {
    this.watchdog.stop();
    this.worker?.terminate();
    this.worker = undefined;
    this.failStart(error);
    for (const call of this.pending.values()) call.reject(error);
    this.pending.clear();
    this.tellIdle();
  }

  /** Replaces a failed worker. */
  private replace(error: StrutError): void {
    this.restart ??= { message: error.message, lost: [] };
    if (!this.proven) for (const thing of this.open) this.lose(thing, "It failed twice in a row.");
    this.proven = false;
    this.stop(error);
    this.running = this.start();
  }
}

/** The error of an engine that could not be loaded. It is not a bug: the browser refuses the code. */
function notReady(error: ErrorParts): StrutError {
  if (error.code !== "fault") return new StrutError(error);
  return new StrutError({
    code: "load",
    message: "The engine could not be started, because the browser blocked its code.",
    hint: `Reload the page; if that does not help, allow WebAssembly on this site, or use another browser. (${error.message})`,
  });
}

function unloadable(why: string): StrutError {
  return new StrutError({
    code: "load",
    message: `The engine's worker could not be started${why ? `: ${why}` : ""}.`,
    hint: "Reload the page; if that does not help, the site was not deployed completely.",
  });
}
