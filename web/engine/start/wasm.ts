/**
 * The WASM package of a page's first seconds: the part of the engine's that plays packed motions on their own database,
 * in two fifths of its bytes. It does not read BVH files, `.strutdb` files or motions of other skeletons, and does not
 * style whole clips.
 */
import { assetOf } from "../assets";
import { type Glue, servePackage } from "../wasm";
import * as glue from "./pkg/strut_start.js";

/** Uses this package as the engine's on this thread. Call it before anything is loaded. */
export function serveStartPackage(): void {
  // The package has the engine's classes with fewer functions; the caller (`client/client.ts`) knows which are missing.
  servePackage(glue as unknown as Glue, () =>
    assetOf("strut_start_bg.wasm", () => new URL("./pkg/strut_start_bg.wasm", import.meta.url)),
  );
}
