/** The entry of the package's worker that builds databases and trains models: a classic script that imports nothing. */
import { serveBuilds } from "../client/build/server";
import type { ServerPort } from "../client/rpc_server";
import { type Boot, placeBooted } from "./boot";

const scope = self as unknown as { onmessage: ((event: MessageEvent<Boot>) => void) | null };
scope.onmessage = ({ data }) => {
  placeBooted(data);
  serveBuilds(scope as unknown as ServerPort);
};
