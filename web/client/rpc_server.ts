/** The worker's side of remote calls. */
import type { BuiltInSet } from "../engine/built_in";
import { fault, toStrutError } from "../engine/errors";
import type { Progress } from "../engine/types";
import type { Reply, Request } from "./rpc";

/** The part of a worker's scope that its server needs. */
export interface ServerPort {
  postMessage(message: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

/** The caller of long work: its cancellation and its progress. */
export interface Caller {
  /** Whether the caller has cancelled. */
  isCancelled(): boolean;
  report(progress: Progress): void;
}

/** Answers a call; it may throw any value. */
type Answer = (method: string, args: unknown[], caller: Caller) => unknown;

/**
 * Answers the calls that arrive at a port.
 * @param preload handles a `preload`
 */
export function answerCalls(port: ServerPort, answer: Answer, preload: (set: BuiltInSet) => void = () => {}): void {
  /** Pending calls, and which of them were cancelled. */
  const cancelled = new Map<number, boolean>();
  const answerCall = async (id: number, method: string, args: unknown[]) => {
    cancelled.set(id, false);
    const caller: Caller = {
      isCancelled: () => cancelled.get(id) === true,
      report: (progress) => port.postMessage({ kind: "progress", id, progress }, []),
    };
    try {
      const value = await answer(method, args, caller);
      port.postMessage({ kind: "result", id, value }, buffersOf(value));
    } catch (thrown) {
      port.postMessage({ kind: "failure", id, error: toStrutError(thrown).parts() }, []);
    } finally {
      cancelled.delete(id);
    }
  };
  port.onmessage = ({ data }) => {
    if (data.kind === "call") void answerCall(data.id, data.method, data.args);
    else if (data.kind === "ping") port.postMessage({ kind: "pong" }, []);
    else if (data.kind === "preload") preload(data.set);
    else if (cancelled.has(data.id)) cancelled.set(data.id, true);
  };
}

/** Answers calls from an object of functions. @throws StrutError `fault` if it lacks the method */
export function answersOf(table: object): Answer {
  return (method, args) => {
    if (!Object.hasOwn(table, method)) throw fault(`There is no call "${method}"`);
    return (table as Record<string, (...args: unknown[]) => unknown>)[method]!(...args);
  };
}

/** The buffers of the typed arrays in an answer at any depth. Answers contain arrays without another owner. */
function buffersOf(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (typeof value !== "object" || value === null) return [];
  return [...new Set(Object.values(value).flatMap(buffersOf))];
}
