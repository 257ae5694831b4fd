/** The worker's entry on the page: one engine behind its port. */
import "../engine/whole";
import { type ServerPort, serve } from "./server/serve";

void serve(self as unknown as ServerPort);
