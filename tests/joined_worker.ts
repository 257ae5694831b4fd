/** Both ends of a worker that answers calls from a table, connected without a thread. */
import {
  type AnswerMessage,
  answerCalls,
  type CallMessage,
  type ClientPort,
  type Methods,
  type ServerPort,
} from "../web/client/rpc";

/** Returns a worker's port on the page's side; messages are copied and transferred as between threads. */
export function joinedWorker(table: Methods, onTerminate: () => void = () => {}): ClientPort {
  const server: ServerPort = {
    onmessage: null,
    postMessage: (message, transfer) =>
      client.onmessage?.({ data: structuredClone(message, { transfer }) } as MessageEvent<AnswerMessage>),
  };
  const client: ClientPort = {
    onmessage: null,
    onerror: null,
    terminate: onTerminate,
    postMessage: (message, transfer) =>
      server.onmessage?.({ data: structuredClone(message, { transfer }) } as MessageEvent<CallMessage>),
  };
  answerCalls(server, table);
  return client;
}
