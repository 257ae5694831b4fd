/** Calls into a worker by name. The client is made from the interface, the server from a table of functions. */
import { cancelled, disposed, type ErrorParts, fault, StrutError, toStrutError } from "../engine/errors";
import { sendPlain } from "./plain";
import { READING_MS, Watchdog } from "./watchdog";

/** How often a silent worker is noticed, milliseconds. */
const STEP_MS = 20_000;

/** Methods that return promises. */
export type Methods = Readonly<Record<string, (...args: never[]) => Promise<unknown>>>;

/** A call on its way to the worker. */
export interface CallMessage {
  id: number;
  method: string;
  args: unknown[];
}

/** The worker's answer. */
export type AnswerMessage = { id: number } & ({ value: unknown } | { error: ErrorParts });

/** The part of a worker that the client needs. */
export interface ClientPort {
  postMessage(message: CallMessage, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<AnswerMessage>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

/** The part of a worker's scope that the server needs. */
export interface ServerPort {
  postMessage(message: AnswerMessage, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<CallMessage>) => void) | null;
}

interface Pending {
  resolve(value: unknown): void;
  reject(error: StrutError): void;
}

/** Makes calls to a worker that starts with the first call. A failed worker is replaced at the next call. */
export class RpcClient {
  readonly #spawn: () => ClientPort;
  #port: ClientPort | undefined;
  #lastId = 0;
  readonly #pending = new Map<number, Pending>();
  #disposed = false;
  readonly #watchdog: Watchdog;

  /**
   * @param spawn starts the worker
   * @param what noun for messages
   * @param limitMs longest silence of a worker that has pending calls; a call may compute in one piece
   */
  constructor(
    spawn: () => ClientPort,
    private readonly what: string,
    limitMs: number = READING_MS,
  ) {
    this.#spawn = spawn;
    this.#watchdog = new Watchdog({
      stepMs: Math.min(limitMs, STEP_MS),
      graceMs: Math.min(limitMs, STEP_MS),
      limitMs: () => limitMs,
      isWaiting: () => this.#pending.size > 0,
      onSilent: () => this.#stop(fault(`The ${what} failed: its worker does not answer`)),
    });
  }

  /** Calls a method; the buffers of `transfer` are transferred. @throws StrutError the worker's, `cancelled` or `disposed` */
  call(method: string, args: unknown[], signal?: AbortSignal, transfer: Transferable[] = []): Promise<unknown> {
    if (this.#disposed) return Promise.reject(disposed(this.what));
    if (signal?.aborted) return Promise.reject(cancelled(signal.reason));
    const id = ++this.#lastId;
    const answer = new Promise<unknown>((resolve, reject) => {
      this.#pending.set(id, { resolve, reject });
      this.#watchdog.restart();
      try {
        sendPlain({ id, method, args }, (message) => this.#started().postMessage(message, transfer));
      } catch (thrown) {
        this.#pending.delete(id);
        reject(toStrutError(thrown));
      }
    });
    const cancel = () => {
      this.#pending.get(id)?.reject(cancelled(signal?.reason));
      this.#pending.delete(id);
    };
    signal?.addEventListener("abort", cancel, { once: true });
    return answer.finally(() => signal?.removeEventListener("abort", cancel));
  }

  /** Terminates the worker and rejects pending calls. */
  dispose(): void {
    this.#disposed = true;
    this.#stop(disposed(this.what));
  }

  #started(): ClientPort {
    if (this.#port) return this.#port;
    const port = this.#spawn();
    port.onmessage = ({ data }) => {
      const pending = this.#pending.get(data.id);
      this.#pending.delete(data.id);
      this.#watchdog.restart();
      if ("error" in data) pending?.reject(new StrutError(data.error));
      else pending?.resolve(data.value);
      if ("error" in data && data.error.code === "fault" && this.#port === port)
        this.#stop(fault(`The ${this.what} failed`));
    };
    port.onerror = ({ message }) => {
      if (this.#port === port) this.#stop(fault(`The ${this.what} failed: ${message || "its worker stopped"}`));
    };
    this.#port = port;
    return port;
  }

  #stop(reason: StrutError): void {
    this.#watchdog.stop();
    this.#port?.terminate();
    this.#port = undefined;
    for (const { reject } of this.#pending.values()) reject(reason);
    this.#pending.clear();
  }
}

/**
 * An object whose methods are remote calls: the methods of `T`, whose last argument may be options with only a `signal`.
 * @param own its other members, which are not calls
 */
export function remote<T extends object, Own extends object = object>(client: RpcClient, own = {} as Own): T & Own {
  const get = (members: object, name: string | symbol) => {
    if (name in members) return Reflect.get(members, name);
    // A promise may resolve with the object: it has no `then`.
    if (typeof name === "symbol" || name === "then") return undefined;
    return (...args: unknown[]) => {
      const options = args.at(-1);
      return isCallOptions(options) ? client.call(name, args.slice(0, -1), options.signal) : client.call(name, args);
    };
  };
  return new Proxy(own, { get }) as T & Own;
}

function isCallOptions(value: unknown): value is { signal: AbortSignal | undefined } {
  if (typeof value !== "object" || value === null || Object.keys(value).join() !== "signal") return false;
  const { signal } = value as { signal: unknown };
  return signal === undefined || signal instanceof AbortSignal;
}

/** Answers the calls that arrive at a port from a table of functions. */
export function answerCalls(port: ServerPort, table: Methods): void {
  port.onmessage = async ({ data: { id, method, args } }) => {
    try {
      const answer = Object.hasOwn(table, method) ? table[method] : undefined;
      if (!answer) throw fault(`There is no call "${method}"`);
      const value = await answer(...(args as never[]));
      port.postMessage({ id, value }, buffersOf(value));
    } catch (thrown) {
      port.postMessage({ id, error: toStrutError(thrown).parts() }, []);
    }
  };
}

/** The buffers of the typed arrays in an answer at any depth. The table returns arrays without another owner. */
function buffersOf(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (typeof value !== "object" || value === null) return [];
  return [...new Set(Object.values(value).flatMap(buffersOf))];
}
