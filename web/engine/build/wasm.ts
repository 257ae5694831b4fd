/** The WASM package that builds databases and trains walks: loaded by the build worker. */
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_wasm_build.js";

/** The generated bindings. */
export type BuildGlue = typeof glue;

/** Where the module is. */
export const BUILD_MODULE = new URL("./pkg/strut_wasm_build_bg.wasm", import.meta.url);

export const buildPackage = new SidePackage(glue, BUILD_MODULE);
