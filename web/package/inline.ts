/** `strut-motion/inline`: the engine in one file; built-in motions, and the code for building and training, are next to it. */
import { baseAddress } from "./assets";
import { placeCharacterFiles } from "./character_files";
import { loadInlined } from "./load_inlined";
import * as servers from "./servers";
import type { LoadOptions, Strut } from "./types";

export { StrutError, type StrutErrorCode } from "../engine/errors";
export type * from "./public";

/**
 * Loads the engine.
 * @throws StrutError `unsupported` if the browser lacks WebAssembly with SIMD, `cancelled`
 */
export async function loadStrut({ assets, ...options }: LoadOptions = {}): Promise<Strut> {
  if (assets !== undefined) placeCharacterFiles(assets, baseAddress());
  return loadInlined(assets ?? new URL("assets/", addressOrPage()).href, options, servers);
}

/** A blob has no folder: its files are searched next to the page. */
function addressOrPage(): string {
  return /^(blob|data):/.test(import.meta.url) ? baseAddress() : import.meta.url;
}
