/** The build worker's entry. */
import { type BuildPort, serveBuilds } from "./server";

serveBuilds(self as unknown as BuildPort);
