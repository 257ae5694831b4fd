/** `strut-motion/three`: rigged characters of three.js perform poses. */
import type { Object3D } from "three";
import { bindCharacter as bind } from "../character/character";
import { type CharacterSource, type LoadCharacterOptions, loadCharacter as load } from "../character/load";
import type { BindOptions, Character, GltfLike, VrmLike } from "../character/types";
import { placeAssets } from "../engine/assets";
import { StrutError } from "../engine/errors";

export type { Licence } from "../character/licence";
export type { CharacterSource, LoadCharacterOptions } from "../character/load";
export type {
  BindOptions,
  Character,
  CharacterClipOptions,
  CharacterMotion,
  GltfLike,
  StyledPoses,
  VrmLike,
} from "../character/types";
export { StrutError, type StrutErrorCode } from "../engine/errors";
export type { Role } from "../humanoid";

/**
 * Binds a character that is in three.js already: an object with a skin, what `GLTFLoader` gives, or a VRM of three-vrm.
 * @throws StrutError `bad-file` with what the model lacks, `bad-input` where an option does not fit it, `load`
 */
export function bindCharacter(root: Object3D | VrmLike | GltfLike, options?: BindOptions): Promise<Character> {
  place();
  return bind(root, options);
}

/**
 * Loads a character: `.glb`, `.vrm` or `.fbx`. The hair and clothes of a VRM swing where `@pixiv/three-vrm` is installed.
 * @throws StrutError `bad-file`, `licence` where its use was not accepted, `load`, `cancelled`
 */
export function loadCharacter(source: CharacterSource, options?: LoadCharacterOptions): Promise<Character> {
  place();
  return load(source, options, importVrm);
}

/** In a `try`, as bundlers only warn of a package there that is not installed. @throws Error where the page does not have it */
async function importVrm() {
  try {
    return await import("@pixiv/three-vrm");
  } catch (cause) {
    throw new Error("three-vrm is not installed.", { cause });
  }
}

/** Says where the module lies, in the form that bundlers look for. @throws StrutError `load` where this file has no address */
function place(): void {
  try {
    placeAssets({
      "strut_wasm_character_bg.wasm": new URL("./assets/strut_wasm_character_bg.wasm", import.meta.url),
    });
  } catch (cause) {
    const message = "The module of characters has no address: this one was loaded from a blob or as data.";
    throw new StrutError({ code: "load", message, hint: "Load it from a file." }, cause);
  }
}
