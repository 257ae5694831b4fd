/** The WASM package of crowds that perform a motion. Only the crowd's worker loads it. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_performers.js";

/** The generated bindings. */
export type PerformersGlue = typeof glue;

export const performersPackage = new SidePackage(glue, () =>
  assetOf("strut_performers_bg.wasm", () => new URL("./pkg/strut_performers_bg.wasm", import.meta.url)),
);
