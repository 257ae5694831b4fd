/** The servers on the calling thread, used without workers. */
import "../engine/whole";

export { serveBuilds } from "../client/build/server";
export { serve } from "../client/server/serve";
