/** The worker's entry on the page: one engine behind its port. */
import "../engine/whole";
import { ATLAS_HANDLERS } from "./server/atlas";
import { type ServerPort, serve } from "./server/serve";

void serve(self as unknown as ServerPort, { atlas: ATLAS_HANDLERS });
