/** A server on the calling thread behind the same port as a worker's: messages arrive asynchronously, as with a real one. */

import type { Reply, Request, WorkerPort } from "../client/rpc";
import type { ServerPort } from "../client/rpc_server";

/** Copies a message; transferred objects are detached from the sender. */
type Copy = <T>(message: T, transfer: Transferable[]) => T;

/** Copies like a worker's port. */
export const structuredCopy: Copy = (message, transfer) => structuredClone(message, { transfer });

export class LocalPort implements WorkerPort {
  onmessage: ((event: MessageEvent<Reply>) => void) | null = null;
  /** Never called: an error on this thread is answered as a failure of its call. */
  onerror: ((event: ErrorEvent) => void) | null = null;
  #ended = false;
  readonly #server: ServerPort;
  /** Settles when the server takes messages. */
  readonly #serving: Promise<void>;
  readonly #copy: Copy;

  /**
   * @param serve starts to serve at a port
   * @param copy copies a message, if its sender may change it afterwards
   */
  constructor(serve: (port: ServerPort) => void | Promise<void>, copy: Copy = (message) => message) {
    this.#copy = copy;
    this.#server = {
      onmessage: null,
      postMessage: (reply, transfer) => {
        const data = copy(reply, transfer);
        queueMicrotask(() => !this.#ended && this.onmessage?.({ data } as MessageEvent<Reply>));
      },
    };
    this.#serving = Promise.resolve(serve(this.#server));
  }

  postMessage(message: Request, transfer: Transferable[]): void {
    const data = this.#copy(message, transfer);
    void this.#serving.then(() => !this.#ended && this.#server.onmessage?.({ data } as MessageEvent<Request>));
  }

  terminate(): void {
    this.#ended = true;
  }
}
