/**
 * The engine's worker on this thread, with the real engine; messages are copied and arrive asynchronously, as with a
 * real one.
 */
import "../web/engine/whole";
import type { CallRequest, Reply, Request, WorkerPort } from "../web/client/rpc";
import type { ServerPort } from "../web/client/rpc_server";
import { ATLAS_HANDLERS } from "../web/client/server/atlas";
import { clipOfDatabase, neutralClips } from "../web/client/server/database_clips";
import { DRIVING_CALLS } from "../web/client/server/driving_calls";
import { recordMotion } from "../web/client/server/recorded_motion";
import { serve } from "../web/client/server/serve";
import type { ErrorParts } from "../web/engine/errors";

/** Answers a call without the engine. */
type Answer = (call: CallRequest) => ErrorParts | undefined;

/** Error of a trap in the engine. */
export const TRAP: ErrorParts = { code: "fault", message: "The engine failed: unreachable.", hint: "" };

export class InlineWorker implements WorkerPort {
  onmessage: ((event: MessageEvent<Reply>) => void) | null = null;
  onerror: ((event: ErrorEvent) => void) | null = null;
  terminated = false;
  readonly received: Request[] = [];
  /** The method whose next call fails as if the engine had trapped. */
  faultAt: string | undefined;
  /** Whether calls are no longer answered, as if the browser had ended the worker. */
  deaf = false;
  private readonly server: ServerPort;
  /** Replies that are delayed while the worker is asleep. */
  private held: Reply[] | undefined;

  /** @param answer refuses calls */
  constructor(private readonly answer: Answer = () => undefined) {
    this.server = {
      onmessage: null,
      postMessage: (reply, transfer) => {
        const data = structuredClone(reply, { transfer });
        setTimeout(() => this.deliver(data), 0);
      },
    };
    void serve(this.server, {
      driving: DRIVING_CALLS,
      page: { ...ATLAS_HANDLERS, recordMotion, neutralClips, clipOfDatabase },
    });
  }

  postMessage(message: Request): void {
    if (this.deaf) return;
    const data = structuredClone(message);
    this.received.push(data);
    const error = data.kind === "call" ? this.refusal(data) : undefined;
    if (data.kind === "call" && error) this.server.postMessage({ kind: "failure", id: data.id, error }, []);
    else setTimeout(() => !this.terminated && this.server.onmessage?.({ data } as MessageEvent<Request>), 0);
  }

  terminate(): void {
    this.terminated = true;
  }

  /** Delays all replies of the worker until {@link wake}, as a browser does while the machine is asleep. */
  sleep(): void {
    this.held = [];
  }

  wake(): void {
    const held = this.held ?? [];
    this.held = undefined;
    for (const data of held) this.deliver(data);
  }

  /** Returns the called methods. */
  calls(): string[] {
    return this.received.flatMap((message) => (message.kind === "call" ? [message.method] : []));
  }

  private refusal(call: CallRequest): ErrorParts | undefined {
    if (call.method !== this.faultAt) return this.answer(call);
    this.faultAt = undefined;
    return TRAP;
  }

  private deliver(data: Reply): void {
    if (this.terminated) return;
    if (this.held) this.held.push(data);
    else this.onmessage?.({ data } as MessageEvent<Reply>);
  }
}
