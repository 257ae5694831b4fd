/** The WASM package of crowds: walk synthesis plus crowds. Only the crowd's worker loads it. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_crowd.js";

/** The generated bindings. */
export type CrowdGlue = typeof glue;

export const crowdPackage = new SidePackage(glue, () =>
  assetOf("strut_crowd_bg.wasm", () => new URL("./pkg/strut_crowd_bg.wasm", import.meta.url)),
);
