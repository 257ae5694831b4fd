/** The WASM package of walk synthesis, loaded with the first walk model. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_wasm_walk.js";

/** The generated bindings. */
export type WalkGlue = typeof glue;

export const walkPackage = new SidePackage(glue, () =>
  assetOf("strut_wasm_walk_bg.wasm", () => new URL("./pkg/strut_wasm_walk_bg.wasm", import.meta.url)),
);
