/** The WASM package of live streams, loaded when a stream starts. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_live.js";

/** The generated bindings. */
export type LiveGlue = typeof glue;

export const livePackage = new SidePackage(glue, () =>
  assetOf("strut_live_bg.wasm", () => new URL("./pkg/strut_live_bg.wasm", import.meta.url)),
);
