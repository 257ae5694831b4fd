/** The files that the engine loads at run time, and their locations. */

/** Names of the files that the engine loads. */
export type AssetName =
  | "strut_wasm_bg.wasm"
  | "strut_start_bg.wasm"
  | "strut_wasm_build_bg.wasm"
  | "strut_wasm_walk_bg.wasm"
  | "strut_crowd_bg.wasm"
  | "strut_performers_bg.wasm"
  | "strut_drive_bg.wasm"
  | "strut_live_bg.wasm"
  | "strut_wasm_key_style_bg.wasm"
  | "strut_wasm_character_bg.wasm"
  | "draco_decoder.wasm"
  | "strut_wasm_gpu_bg.wasm"
  | "strut_compare_bg.wasm"
  | "strut_learn_bg.wasm"
  | "first.bin"
  | "built_in.bin"
  | "walk.bin"
  | "drive.bin"
  | "first_steps.bin"
  | "built_in.strutwalk";

/** Location of a file, or its bytes. */
export type Asset = URL | Uint8Array<ArrayBuffer>;

/** Files that are not next to the engine's code. */
type Assets = Readonly<Partial<Record<AssetName, Asset>>>;

let placed: Assets = {};

/**
 * Sets the locations of files on this thread. Call it before anything is loaded. Files that are not in `assets` keep
 * their location.
 */
export function placeAssets(assets: Assets): void {
  placed = { ...placed, ...assets };
}

/** Location of a file: the one set by {@link placeAssets}, or else `beside`, next to the engine's code. */
export function assetOf(name: AssetName, beside: () => URL): Asset {
  return placed[name] ?? beside();
}
