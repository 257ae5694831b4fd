/** The WASM package that builds databases and trains walk models. The build worker loads it. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_wasm_build.js";

/** The generated bindings. */
export type BuildGlue = typeof glue;

/** Location of the module. */
export const buildModule = () =>
  assetOf("strut_wasm_build_bg.wasm", () => new URL("./pkg/strut_wasm_build_bg.wasm", import.meta.url));

export const buildPackage = new SidePackage(glue, buildModule);
