/** `strut-motion/three`: rigged characters of three.js perform poses. */
import type { Object3D } from "three";
import { bindCharacter as bind } from "../character/character";
import { type LoadCharacterOptions, loadCharacter as load, loadMotions as readMotions } from "../character/load";
import type { CharacterSource } from "../character/read";
import type { BindOptions, Character, CharacterMotion, GltfLike, VrmLike } from "../character/types";
import { placeAssets } from "../engine/assets";
import { StrutError } from "../engine/errors";
import type { CallOptions } from "../engine/types";
import { placedCharacterFile } from "./character_files";

export { JointsError } from "../character/joints_error";
export type { Licence } from "../character/licence";
export type { LoadCharacterOptions } from "../character/load";
export type { CharacterSource } from "../character/read";
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
 * Binds a character that already exists in three.js: an object with a skin, a result of `GLTFLoader`, or a VRM of
 * three-vrm.
 * @throws StrutError `bad-file` with what the model lacks, `bad-input` if an option does not fit it, `load`
 */
export function bindCharacter(root: Object3D | VrmLike | GltfLike, options?: BindOptions): Promise<Character> {
  place();
  return bind(root, options);
}

/**
 * Loads a character: `.glb`, `.vrm` or `.fbx`. The hair and clothes of a VRM swing if `@pixiv/three-vrm` is installed.
 * @throws StrutError `bad-file`, `licence` if its use was not accepted, `load`, `cancelled`
 */
export function loadCharacter(source: CharacterSource, options?: LoadCharacterOptions): Promise<Character> {
  place();
  return load(source, options, threeVrm);
}

/** three-vrm, if the page has it. Bundlers ignore a missing module only inside `try`. */
async function threeVrm() {
  try {
    return await import("@pixiv/three-vrm");
  } catch {
    return undefined;
  }
}

/**
 * The motions of a file, with or without a character in it: `.glb`, `.vrm`, `.fbx` or `.vrma`. `Strut.openMotion` opens
 * the result of {@link CharacterMotion.toBVH}.
 * @throws StrutError `bad-file`, `load`, `cancelled`
 */
export function loadMotions(source: CharacterSource, call?: CallOptions & BindOptions): Promise<CharacterMotion[]> {
  place();
  return readMotions(source, call);
}

/**
 * Sets the locations of the files: those given by `loadStrut({ assets })`, or else next to this file, in the form that
 * bundlers recognise.
 * @throws StrutError `load` if this file has no URL
 */
function place(): void {
  try {
    const beside = {
      "strut_wasm_character_bg.wasm": new URL("./assets/strut_wasm_character_bg.wasm", import.meta.url),
      "draco_decoder.wasm": new URL("./assets/draco_decoder.wasm", import.meta.url),
    };
    const placed = (file: keyof typeof beside) => new URL(placedCharacterFile(file) ?? beside[file]);
    placeAssets({
      "strut_wasm_character_bg.wasm": placed("strut_wasm_character_bg.wasm"),
      "draco_decoder.wasm": placed("draco_decoder.wasm"),
    });
  } catch (cause) {
    const message =
      "The location of the character module is unknown, because this module was loaded from a blob: or data: URL.";
    throw new StrutError({ code: "load", message, hint: "Load it from a file or an http: URL." }, cause);
  }
}
