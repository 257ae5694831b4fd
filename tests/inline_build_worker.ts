/** The build worker on this thread, with the real module; messages arrive asynchronously, as from a real one. */
import type { BuildWorkerPort } from "../web/client/build/client";
import type { BuildReply, BuildRequest } from "../web/client/build/messages";
import { type BuildPort, serveBuilds } from "../web/client/build/server";

export class InlineBuildWorker implements BuildWorkerPort {
  onmessage: ((event: MessageEvent<BuildReply>) => void) | null = null;
  onerror: ((event: ErrorEvent) => void) | null = null;
  /** All requests to the worker. */
  readonly received: BuildRequest[] = [];
  terminated = false;
  private readonly port: BuildPort;

  constructor() {
    this.port = {
      onmessage: null,
      postMessage: (data) =>
        queueMicrotask(() => !this.terminated && this.onmessage?.({ data } as MessageEvent<BuildReply>)),
    };
    serveBuilds(this.port);
  }

  postMessage(data: BuildRequest): void {
    this.received.push(data);
    queueMicrotask(() => !this.terminated && this.port.onmessage?.({ data } as MessageEvent<BuildRequest>));
  }

  terminate(): void {
    this.terminated = true;
  }
}
