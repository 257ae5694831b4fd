/**
 * `strut-character.js`: loads characters for `strut-player.js`, with three.js and its loaders, three-vrm and the module
 * of characters in one classic script, which runs in frames without an origin. Only files that are compressed with
 * Draco need another file, `assets/draco_decoder.wasm`: it has a fifth of this script's size, and few files need it.
 */
import characters from "strut-inline:strut_wasm_character_bg.wasm";
import { loadCharacter } from "../character/load";
import { placeAssets } from "../engine/assets";
import { inflate } from "./inflate";
import { RECEIVER } from "./script";

const { src } = document.currentScript as HTMLScriptElement;

const load: typeof loadCharacter = async (source, options) => {
  placeAssets({
    "strut_wasm_character_bg.wasm": await inflate(characters),
    "draco_decoder.wasm": new URL("assets/draco_decoder.wasm", src),
  });
  return loadCharacter(source, options, () => import("@pixiv/three-vrm"));
};

(globalThis as unknown as Record<string, ((given: { loadCharacter: typeof load }) => void) | undefined>)[RECEIVER]?.({
  loadCharacter: load,
});
