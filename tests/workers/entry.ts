/** The engine's worker as a thread of Node. */
import "../../web/engine/whole";
import { parentPort } from "node:worker_threads";
import type { Request } from "../../web/client/rpc";
import type { ServerPort } from "../../web/client/rpc_server";
import { serve } from "../../web/client/server/serve";

const parent = parentPort!;
const port: ServerPort = {
  onmessage: null,
  postMessage: (reply, transfer) => parent.postMessage(reply, transfer as ArrayBuffer[]),
};
parent.on("message", (data: Request) => port.onmessage?.({ data } as MessageEvent<Request>));
void serve(port);
