/** The entry of the Compare view's worker: the engine's server over a package with more functions. */
import { counterpartOf, SearchComparison, serveComparePackage } from "../../engine/compare/wasm";
import type { ServerPort } from "../rpc_server";
import { compareSearch } from "../server/searches";
import { serve } from "../server/serve";

serveComparePackage();
void serve(self as unknown as ServerPort, {
  counterparts: counterpartOf,
  compareSearch: (...call) => compareSearch((...setup) => new SearchComparison(...setup), ...call),
});
