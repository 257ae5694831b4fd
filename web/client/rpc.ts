/** Remote calls to a worker: the messages, and the caller's side of one worker with abort, progress and watchdog. */
import type { BuiltInSet } from "../engine/built_in";
import { cancelled, type ErrorParts, fault, StrutError, toStrutError } from "../engine/errors";
import type { Progress } from "../engine/types";
import { sendPlain } from "./plain";
import { Watchdog } from "./watchdog";

/** A call on its way to the worker; the caller numbers its calls. */
export interface CallRequest {
  kind: "call";
  id: number;
  method: string;
  args: unknown[];
}

/**
 * Page → worker. A cancellation that arrives too late has no effect. A `ping` is answered by a `pong` at once. A
 * `preload`, of a set of built-in motions that will be needed, is not answered.
 */
export type Request =
  | CallRequest
  | { kind: "cancel"; id: number }
  | { kind: "ping" }
  | { kind: "preload"; set: BuiltInSet };

/** Worker → page. Every call is answered by one `result` or `failure`, after any number of `progress`. */
export type Reply =
  /** Sent once, without a request, by the engine: it is loaded, or could not be loaded. */
  | { kind: "ready" }
  | { kind: "not-ready"; error: ErrorParts }
  | { kind: "pong" }
  | { kind: "progress"; id: number; progress: Progress }
  | { kind: "result"; id: number; value: unknown }
  | { kind: "failure"; id: number; error: ErrorParts };

/** The part of a `Worker` that its caller needs. */
export interface WorkerPort {
  postMessage(message: Request, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Reply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

/** Arguments and result of the method `M` of an interface of calls. */
export type ArgumentsOf<T, M extends keyof T> = T[M] extends (...args: infer A) => unknown ? A : never;
export type ResultOf<T, M extends keyof T> = T[M] extends (...args: never[]) => infer R ? Awaited<R> : never;

/** Options of one call. */
export interface RemoteCallOptions {
  signal?: AbortSignal | undefined;
  onProgress?: ((progress: Progress) => void) | undefined;
  /** Buffers that the worker takes over. */
  transfer?: Transferable[];
  /** The call succeeded after it was aborted. */
  onLate?: () => void;
}

interface WorkerSetup {
  /** Noun for messages. */
  what: string;
  /** Name of the worker's script, for browsers that do not report why it cannot be loaded. */
  script?: string | undefined;
  /** How often the silence of a worker with pending calls is compared with its limit, milliseconds. */
  silenceMs: number;
  /** Time for the last message of a worker that was silent too long, milliseconds. */
  graceMs: number;
  /** Whether that message may be the answer to a ping; otherwise only one about a call counts. */
  pings: boolean;
  /** Longest silence while these methods are pending, milliseconds; `silenceMs` by default. */
  limitMs?: (methods: readonly string[]) => number;
  /** The worker has failed: it is terminated, and its calls are rejected. */
  onFail: (error: StrutError) => void;
}

interface Pending {
  method: string;
  resolve(value: unknown): void;
  reject(error: StrutError): void;
  onProgress: (progress: Progress) => void;
}

/** One worker with its unanswered calls, until it fails or is ended. `T` is the interface of its calls. */
export class RemoteWorker<T extends object> {
  /** Resolves when the worker reports that it is ready. Rejects if it ends before. */
  readonly ready: Promise<void>;
  #setReady!: () => void;
  #setUnready!: (error: StrutError) => void;
  /** Whether the worker has sent anything, so that its script runs. */
  #hasStarted = false;
  #ended: StrutError | undefined;
  #lastId = 0;
  readonly #pending = new Map<number, Pending>();
  readonly #whenIdle: (() => void)[] = [];
  readonly #watchdog: Watchdog;

  constructor(
    private readonly port: WorkerPort,
    private readonly setup: WorkerSetup,
  ) {
    const { what, script, silenceMs, graceMs, pings, limitMs = () => silenceMs } = setup;
    this.ready = new Promise((resolve, reject) => {
      [this.#setReady, this.#setUnready] = [resolve, reject];
    });
    // Calls are rejected with the same error.
    this.ready.catch(() => {});
    this.#watchdog = new Watchdog({
      stepMs: silenceMs,
      graceMs,
      limitMs: () => limitMs([...this.#pending.values()].map(({ method }) => method)),
      isWaiting: () => this.#pending.size > 0,
      ping: () => pings && port.postMessage({ kind: "ping" }, []),
      onSilent: () => this.#fail(fault(`The ${what} failed: its worker does not answer`)),
    });
    port.onmessage = ({ data }) => !this.#ended && this.#receive(data);
    port.onerror = ({ message }) =>
      this.#fail(
        this.#hasStarted
          ? fault(`The ${what} failed: ${message || "its worker stopped"}`)
          : unloadable(what, message || (script ? `${script} could not be loaded` : "")),
      );
  }

  /**
   * Calls a method. An aborted call is rejected at once.
   * @throws StrutError the worker's, `bad-input` if an argument cannot be sent, `cancelled`, or why the worker ended
   */
  call<M extends keyof T & string>(
    method: M,
    args: ArgumentsOf<T, M>,
    { signal, onProgress, transfer = [], onLate }: RemoteCallOptions = {},
  ): Promise<ResultOf<T, M>> {
    const id = ++this.#lastId;
    const send = () =>
      new Promise<unknown>((resolve, reject) => {
        if (this.#ended) return reject(this.#ended);
        const report = (progress: Progress) => !signal?.aborted && onProgress?.(progress);
        this.#pending.set(id, { method, resolve, reject, onProgress: report });
        this.#watchdog.restart();
        try {
          sendPlain({ kind: "call" as const, id, method, args }, (call) => this.port.postMessage(call, transfer));
        } catch (thrown) {
          this.#settled(id)?.reject(toStrutError(thrown));
        }
      });
    return abortable(signal, send, (answer) => {
      this.port.postMessage({ kind: "cancel", id }, []);
      answer.then(onLate, () => {});
    }) as Promise<ResultOf<T, M>>;
  }

  /** Resolves when no call is in progress; an aborted call is in progress until the worker has answered it. */
  idle(): Promise<void> {
    return this.#pending.size === 0 ? Promise.resolve() : new Promise((resolve) => this.#whenIdle.push(resolve));
  }

  /** Terminates the worker and rejects its calls. */
  end(error: StrutError): void {
    if (this.#ended) return;
    this.#ended = error;
    this.#watchdog.stop();
    this.port.terminate();
    this.#setUnready(error);
    for (const id of [...this.#pending.keys()]) this.#settled(id)?.reject(error);
  }

  #fail(error: StrutError): void {
    if (this.#ended) return;
    this.end(error);
    this.setup.onFail(error);
  }

  #receive(reply: Reply): void {
    this.#hasStarted = true;
    this.#watchdog.restart();
    if (reply.kind === "ready") this.#setReady();
    else if (reply.kind === "not-ready") this.#fail(new StrutError(reply.error));
    else if (reply.kind === "progress") this.#pending.get(reply.id)?.onProgress(reply.progress);
    else if (reply.kind === "result") this.#settled(reply.id)?.resolve(reply.value);
    else if (reply.kind === "failure") {
      const error = new StrutError(reply.error);
      this.#settled(reply.id)?.reject(error);
      // The instance that failed takes no more calls.
      if (error.code === "fault") this.#fail(error);
    }
  }

  /** Removes a call from the pending ones. */
  #settled(id: number): Pending | undefined {
    const call = this.#pending.get(id);
    this.#pending.delete(id);
    if (this.#pending.size === 0) for (const resolve of this.#whenIdle.splice(0)) resolve();
    return call;
  }
}

/**
 * The result of `start`, or a rejection as soon as the signal is aborted. If it was aborted before, nothing is started.
 * @throws StrutError `cancelled`
 */
export async function abortable<T>(
  signal: AbortSignal | undefined,
  start: () => Promise<T>,
  onAbort: (started: Promise<T>) => void = () => {},
): Promise<T> {
  if (signal?.aborted) throw cancelled(signal.reason);
  const started = start();
  if (!signal) return started;
  let abort = () => {};
  const aborted = new Promise<never>((_, reject) => {
    abort = () => {
      onAbort(started);
      reject(cancelled(signal.reason));
    };
  });
  signal.addEventListener("abort", abort, { once: true });
  try {
    return await Promise.race([started, aborted]);
  } finally {
    signal.removeEventListener("abort", abort);
  }
}

/** The error of a worker that never sent a message. @param why the reason, empty if the browser does not report it */
function unloadable(what: string, why: string): StrutError {
  return new StrutError({
    code: "load",
    message: `The ${what} could not be started${why ? `: ${why}` : ""}.`,
    hint: "Reload the page; if that does not help, the site was not deployed completely.",
  });
}
