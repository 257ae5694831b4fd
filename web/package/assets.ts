/** The files next to the package's code. */

import type { AssetName } from "../engine/assets";

/** Files that the engine loads itself, and files for building databases, walking, key-styling and live streams. */
export const ENGINE_ASSETS = [
  "strut_wasm_bg.wasm",
  "strut_wasm_build_bg.wasm",
  "strut_wasm_walk_bg.wasm",
  "strut_wasm_key_style_bg.wasm",
  "strut_live_bg.wasm",
  "walk.bin",
  "built_in.bin",
] as const satisfies AssetName[];

/** Files loaded with the first character, and with the first one that is compressed with Draco. */
export const CHARACTER_ASSETS = ["strut_wasm_character_bg.wasm", "draco_decoder.wasm"] as const satisfies AssetName[];

export type CharacterAsset = (typeof CHARACTER_ASSETS)[number];

export type EngineAsset = (typeof ENGINE_ASSETS)[number];

/** Files that the engine requests. For the first strides, with which the page starts, the package provides all walks. */
export type PlacedAsset = EngineAsset | "first.bin";

/** Absolute URLs of the engine's files. */
export type EnginePlaces = Readonly<Record<PlacedAsset, string>>;

/**
 * The URL of a file according to the caller's `assets`.
 * @param assets `LoadOptions.assets`
 * @param base base of relative URLs
 * @throws TypeError if it is not a URL
 */
export function placeIn(assets: string | ((file: string) => string), file: string, base: string): string {
  const address = typeof assets === "string" ? `${assets.replace(/\/?$/, "/")}${file}` : assets(file);
  return new URL(address, base).href;
}

/** Base of relative URLs: the page, or the worker in which the package is used. */
export function baseAddress(): string {
  return typeof document === "object" ? document.baseURI : location.href;
}

/** The URLs of all engine files, from a function that returns one. */
export function placesBy(place: (file: EngineAsset) => string): EnginePlaces {
  const places = Object.fromEntries(ENGINE_ASSETS.map((name) => [name, place(name)])) as Record<EngineAsset, string>;
  return { ...places, "first.bin": places["walk.bin"] };
}
