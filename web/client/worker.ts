/** The worker's entry: one engine behind its port. */
import { type ServerPort, serve } from "./server/serve";

void serve(self as unknown as ServerPort);
