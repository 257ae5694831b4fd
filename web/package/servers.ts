/** The servers on the calling thread, where there is no worker. */
import "../engine/whole";

export { serveBuilds } from "../client/build/server";
export { serve } from "../client/server/serve";
