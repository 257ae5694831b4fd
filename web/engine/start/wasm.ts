/**
 * The WASM package of a page's first seconds: as much of the engine's as plays packed motions on their own database, in two
 * fifths of its bytes. It has no BVH files, no `.strutdb` files, no motions of other skeletons, and no clips as a whole.
 */
import { assetOf } from "../assets";
import { type Glue, servePackage } from "../wasm";
import * as glue from "./pkg/strut_start.js";

/** Uses this package as the engine's on this thread; call it before anything is loaded. */
export function serveStartPackage(): void {
  // The same classes with fewer functions: who asks this thread knows what it has (`client/client.ts`).
  servePackage(glue as unknown as Glue, () =>
    assetOf("strut_start_bg.wasm", () => new URL("./pkg/strut_start_bg.wasm", import.meta.url)),
  );
}
