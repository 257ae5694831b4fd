/** The worker's entry on the page: one engine behind its port. */
import "../engine/whole";
import type { ServerPort } from "./rpc_server";
import { ATLAS_HANDLERS } from "./server/atlas";
import { clipOfDatabase, neutralClips } from "./server/database_clips";
import { DRIVING_CALLS } from "./server/driving_calls";
import { recordMotion } from "./server/recorded_motion";
import { serve } from "./server/serve";

void serve(self as unknown as ServerPort, {
  driving: DRIVING_CALLS,
  page: { ...ATLAS_HANDLERS, recordMotion, neutralClips, clipOfDatabase },
});
