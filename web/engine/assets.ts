/** The files that the engine loads at run time, and where they lie. */

/** Names of the files. */
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

/** Where a file lies, or its bytes. */
export type Asset = URL | Uint8Array<ArrayBuffer>;

/** Files that lie elsewhere than beside the engine's code. */
export type Assets = Readonly<Partial<Record<AssetName, Asset>>>;

let placed: Assets = {};

/** Says where files lie on this thread; call it before anything is loaded. Places of other files stay. */
export function placeAssets(assets: Assets): void {
  placed = { ...placed, ...assets };
}

/** A file that lies `beside` the engine's code unless {@link placeAssets} said otherwise. */
export function assetOf(name: AssetName, beside: () => URL): Asset {
  return placed[name] ?? beside();
}
