/**
 * The WASM package of the Compare view: the engine's, plus the methods that are trained beforehand, the search by
 * kd-trees and the built-in inputs in every style. Only the Compare view loads it.
 */
import { assetOf } from "../assets";
import { performedBy } from "../performed";
import type { Performed } from "../types";
import { type Glue, servePackage } from "../wasm";
import * as glue from "./pkg/strut_compare.js";

export { SearchComparison } from "./search_comparison";

/** Uses this package as the engine's on this thread. Call it before anything is loaded. */
export function serveComparePackage(): void {
  // The package has the engine's classes and more. TypeScript treats the classes of two packages as different types.
  servePackage(glue as unknown as Glue, () =>
    assetOf("strut_compare_bg.wasm", () => new URL("./pkg/strut_compare_bg.wasm", import.meta.url)),
  );
}

/** A built-in input as performed in a style; `undefined` if there is no such input or style. */
export function counterpartOf(input: string, style: string): Performed | undefined {
  return performedBy(glue, input, style);
}
