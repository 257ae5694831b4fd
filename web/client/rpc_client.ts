/** Calls to a worker without state that must be restored: it starts with the first call, and again after a failure. */
import { cancelled, disposed, type StrutError, toStrutError } from "../engine/errors";
import { type ArgumentsOf, type RemoteCallOptions, RemoteWorker, type ResultOf, type WorkerPort } from "./rpc";
import { READING_MS } from "./watchdog";

/** How often a silent worker is noticed, milliseconds. */
const STEP_MS = 20_000;

/** Makes calls to a worker that starts with the first call. `T` is the interface of the calls. */
export class RpcClient<T extends object> {
  #worker: RemoteWorker<T> | undefined;
  #disposed = false;

  /**
   * @param spawn starts the worker
   * @param what noun for messages
   * @param limitMs longest silence of a worker that has pending calls; a call may compute in one piece
   * @param script name of the worker's script, for messages
   */
  constructor(
    private readonly spawn: () => WorkerPort,
    private readonly what: string,
    private readonly limitMs: number = READING_MS,
    private readonly script?: string,
  ) {}

  /** Whether a worker runs. */
  get isRunning(): boolean {
    return this.#worker !== undefined;
  }

  /** Makes a call; see {@link RemoteWorker.call}. @throws StrutError `disposed` too */
  async call<M extends keyof T & string>(
    method: M,
    args: ArgumentsOf<T, M>,
    options?: RemoteCallOptions,
  ): Promise<ResultOf<T, M>> {
    if (this.#disposed) throw disposed(this.what);
    if (options?.signal?.aborted) throw cancelled(options.signal.reason);
    try {
      this.#worker ??= this.#start();
    } catch (thrown) {
      throw toStrutError(thrown);
    }
    return this.#worker.call(method, args, options);
  }

  /** Resolves when no call is in progress. */
  async idle(): Promise<void> {
    await this.#worker?.idle();
  }

  /** Terminates the worker and rejects its calls. The next call starts another. */
  stop(reason: StrutError): void {
    this.#worker?.end(reason);
    this.#worker = undefined;
  }

  /** Terminates the worker and rejects pending and later calls. */
  dispose(): void {
    this.#disposed = true;
    this.stop(disposed(this.what));
  }

  #start(): RemoteWorker<T> {
    const stepMs = Math.min(this.limitMs, STEP_MS);
    const worker = new RemoteWorker<T>(this.spawn(), {
      what: this.what,
      script: this.script,
      silenceMs: stepMs,
      graceMs: stepMs,
      pings: false,
      limitMs: () => this.limitMs,
      onFail: () => {
        if (this.#worker === worker) this.#worker = undefined;
      },
    });
    return worker;
  }
}

/**
 * An object whose methods are remote calls: the methods of `T`, whose last argument may be options with only a `signal`.
 * @param own its other members, which are not calls
 */
export function remote<T extends object, Own extends object = object>(client: RpcClient<T>, own = {} as Own): T & Own {
  const get = (members: object, name: string | symbol) => {
    if (name in members) return Reflect.get(members, name);
    // A promise may resolve with the object: it has no `then`.
    if (typeof name === "symbol" || name === "then") return undefined;
    return (...args: unknown[]) => {
      const options = args.at(-1);
      const call = (sent: unknown[], signal?: AbortSignal) =>
        client.call(name as keyof T & string, sent as ArgumentsOf<T, keyof T & string>, signal && { signal });
      return isCallOptions(options) ? call(args.slice(0, -1), options.signal) : call(args);
    };
  };
  return new Proxy(own, { get }) as T & Own;
}

function isCallOptions(value: unknown): value is { signal: AbortSignal | undefined } {
  if (typeof value !== "object" || value === null || Object.keys(value).join() !== "signal") return false;
  const { signal } = value as { signal: unknown };
  return signal === undefined || signal instanceof AbortSignal;
}
