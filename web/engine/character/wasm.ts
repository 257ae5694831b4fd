/** The WASM package of rigged characters, loaded with the first character. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_wasm_character.js";

/** The generated bindings. */
export type CharacterGlue = typeof glue;

export const characterPackage = new SidePackage(glue, () =>
  assetOf("strut_wasm_character_bg.wasm", () => new URL("./pkg/strut_wasm_character_bg.wasm", import.meta.url)),
);
