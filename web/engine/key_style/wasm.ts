/** The WASM package of key-style synthesis, loaded with the first key-style model. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_wasm_key_style.js";

/** The generated bindings. */
export type KeyStyleGlue = typeof glue;

export const keyStylePackage = new SidePackage(glue, () =>
  assetOf("strut_wasm_key_style_bg.wasm", () => new URL("./pkg/strut_wasm_key_style_bg.wasm", import.meta.url)),
);
