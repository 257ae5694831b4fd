/** The wire format between `client.ts` and `server.ts`; the page sees only `protocol.ts`. */
import type { ErrorParts } from "../engine/errors";
import type { CallOptions, Progress, StrutClient } from "./protocol";

/** The methods of {@link StrutClient} that the worker answers. */
export type Method = Exclude<keyof StrutClient, "onRestart" | "dispose">;

type WithoutOptions<A extends unknown[]> = A extends [...infer Rest, options?: CallOptions] ? Rest : A;
/** Arguments of a method as they travel: signal and progress become messages. */
export type Arguments<M extends Method> = WithoutOptions<Parameters<StrutClient[M]>>;
/** What a method resolves to. */
export type Result<M extends Method> = Awaited<ReturnType<StrutClient[M]>>;

/** A call under way; the client numbers its calls. */
export type Call = { [M in Method]: { kind: "call"; id: number; method: M; args: Arguments<M> } }[Method];

/** Page → worker. A cancellation that comes too late has no effect. */
export type Request = Call | { kind: "cancel"; id: number };

/** Worker → page. Every call is answered by one `result` or `failure`, after any number of `progress`. */
export type Reply =
  /** Sent once, unasked: the engine is loaded, or could not be. */
  | { kind: "ready" }
  | { kind: "not-ready"; error: ErrorParts }
  | { kind: "progress"; id: number; progress: Progress }
  | { kind: "result"; id: number; value: Result<Method> }
  | { kind: "failure"; id: number; error: ErrorParts };
