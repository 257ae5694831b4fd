/**
 * The WASM package of the Compare view: the engine's, with the methods that are trained beforehand, the search by kd-trees
 * and the built-in inputs in every style. Only the Compare view loads it.
 */
import { assetOf } from "../assets";
import { performedBy } from "../performed";
import type { Performed } from "../types";
import { type Glue, servePackage } from "../wasm";
import * as glue from "./pkg/strut_compare.js";

export { SearchComparison } from "./search_comparison";

/** Uses this package as the engine's on this thread; call it before anything is loaded. */
export function serveComparePackage(): void {
  // The same classes with some more: those of two packages are only different by name.
  servePackage(glue as unknown as Glue, () =>
    assetOf("strut_compare_bg.wasm", () => new URL("./pkg/strut_compare_bg.wasm", import.meta.url)),
  );
}

/** A built-in input as a style performs it; `undefined` where there is no such input or style. */
export function counterpartOf(input: string, style: string): Performed | undefined {
  return performedBy(glue, input, style);
}
