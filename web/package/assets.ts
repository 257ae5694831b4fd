/** The files beside the package's code. */

import type { AssetName } from "../engine/assets";

/** What the engine loads by itself, and what those load who build databases, walk, pose by style variables, or perform. */
export const ENGINE_ASSETS = [
  "strut_wasm_bg.wasm",
  "strut_wasm_build_bg.wasm",
  "strut_wasm_walk_bg.wasm",
  "strut_wasm_key_style_bg.wasm",
  "strut_live_bg.wasm",
  "walk.bin",
  "built_in.bin",
] as const satisfies AssetName[];

/** What is loaded with the first character, and with the first that is compressed with Draco. */
export const CHARACTER_ASSETS = ["strut_wasm_character_bg.wasm", "draco_decoder.wasm"] as const satisfies AssetName[];

export type CharacterAsset = (typeof CHARACTER_ASSETS)[number];

export type EngineAsset = (typeof ENGINE_ASSETS)[number];

/** What the engine asks for: where the page begins with a few strides, the package has all walks. */
export type PlacedAsset = EngineAsset | "first.bin";

/** Addresses of the engine's files, absolute URLs. */
export type EnginePlaces = Readonly<Record<PlacedAsset, string>>;

/**
 * The address of a file where the caller says that the files lie.
 * @param assets `LoadOptions.assets`
 * @param base what relative addresses are relative to
 * @throws TypeError if that is not an address
 */
export function placeIn(assets: string | ((file: string) => string), file: string, base: string): string {
  const address = typeof assets === "string" ? `${assets.replace(/\/?$/, "/")}${file}` : assets(file);
  return new URL(address, base).href;
}

/** What relative addresses are relative to: the page, or the worker in which the package is used. */
export function baseAddress(): string {
  return typeof document === "object" ? document.baseURI : location.href;
}

/** The addresses of all engine files by a function that gives one. */
export function placesBy(place: (file: EngineAsset) => string): EnginePlaces {
  const places = Object.fromEntries(ENGINE_ASSETS.map((name) => [name, place(name)])) as Record<EngineAsset, string>;
  return { ...places, "first.bin": places["walk.bin"] };
}
