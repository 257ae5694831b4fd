/** The entry of the worker of a page's first seconds: the engine's server over a package that only plays. */
import { serveStartPackage } from "../engine/start/wasm";
import type { ServerPort } from "./rpc_server";
import { serve } from "./server/serve";

serveStartPackage();
void serve(self as unknown as ServerPort);
