/** The WASM package of crowds who perform a motion, loaded in the crowd's worker alone. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_performers.js";

/** The generated bindings. */
export type PerformersGlue = typeof glue;

export const performersPackage = new SidePackage(glue, () =>
  assetOf("strut_performers_bg.wasm", () => new URL("./pkg/strut_performers_bg.wasm", import.meta.url)),
);
