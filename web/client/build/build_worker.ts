/** The build worker's entry. */
import type { ServerPort } from "../rpc_server";
import { serveBuilds } from "./server";

serveBuilds(self as unknown as ServerPort);
