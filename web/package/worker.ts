/** The entry of the package's worker: a classic script that imports nothing. */
import "../engine/whole";
import type { ServerPort } from "../client/rpc_server";
import { serve } from "../client/server/serve";
import { type Boot, placeBooted, STARTED } from "./boot";

/** The part of a worker's global scope that is needed at its start. */
interface Scope {
  onmessage: ((event: MessageEvent<Boot>) => void) | null;
  postMessage(message: string): void;
}

const scope = self as unknown as Scope;
scope.onmessage = ({ data }) => {
  placeBooted(data);
  void serve(scope as unknown as ServerPort);
};
scope.postMessage(STARTED);
