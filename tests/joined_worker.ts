/** Both ends of a worker that answers calls from a table, connected without a thread. */
import type { Reply, Request, WorkerPort } from "../web/client/rpc";
import { answerCalls, answersOf, type ServerPort } from "../web/client/rpc_server";

/** Returns a worker's port on the page's side; messages are copied and transferred as between threads. */
export function joinedWorker(table: object, onTerminate: () => void = () => {}): WorkerPort {
  const server: ServerPort = {
    onmessage: null,
    postMessage: (message, transfer) =>
      client.onmessage?.({ data: structuredClone(message, { transfer }) } as MessageEvent<Reply>),
  };
  const client: WorkerPort = {
    onmessage: null,
    onerror: null,
    terminate: onTerminate,
    postMessage: (message, transfer) =>
      server.onmessage?.({ data: structuredClone(message, { transfer }) } as MessageEvent<Request>),
  };
  answerCalls(server, answersOf(table));
  return client;
}
