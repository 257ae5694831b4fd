/** The engine's server on the calling thread, behind the same port as a worker's: messages are copied and arrive later. */
import type { WorkerPort } from "../client/connection";
import type { Reply, Request } from "../client/messages";
import type { ServerPort } from "../client/server/serve";

export class LocalPort implements WorkerPort {
  onmessage: ((event: MessageEvent<Reply>) => void) | null = null;
  /** Nothing is reported here: what fails on this thread is answered as a failure of its call. */
  onerror: ((event: ErrorEvent) => void) | null = null;
  #ended = false;
  readonly #server: ServerPort;

  /** @param serve begins to serve at a port */
  constructor(serve: (port: ServerPort) => void) {
    this.#server = {
      onmessage: null,
      postMessage: (reply, transfer) => {
        const data = structuredClone(reply, { transfer });
        queueMicrotask(() => !this.#ended && this.onmessage?.({ data } as MessageEvent<Reply>));
      },
    };
    serve(this.#server);
  }

  postMessage(message: Request): void {
    const data = structuredClone(message);
    queueMicrotask(() => !this.#ended && this.#server.onmessage?.({ data } as MessageEvent<Request>));
  }

  terminate(): void {
    this.#ended = true;
  }
}
