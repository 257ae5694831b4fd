/** `strut-motion/inline`: the engine in one file; only the built-in motions lie beside it. */
import engine from "strut-inline:strut_wasm_bg.wasm";
import workerText from "strut-inline:worker.js";
import { placeIn, placesBy } from "./assets";
import { serveBooted } from "./boot";
import { loadEngine } from "./load";
import { startEngine } from "./start";
import type { LoadOptions, Strut } from "./types";

export { StrutError, type StrutErrorCode } from "../engine/errors";
export type * from "./public";

/**
 * Loads the engine.
 * @throws StrutError `unsupported` if the browser lacks WebAssembly with SIMD, `cancelled`
 */
export async function loadStrut({ assets, worker = true, signal }: LoadOptions = {}): Promise<Strut> {
  const folder = assets ?? new URL("assets/", addressOrPage()).href;
  const places = placesBy((file) => placeIn(folder, file, document.baseURI));
  const entry = {
    workerUrl: undefined,
    workerText: async () => workerText,
    server: async () => ({ serveBooted }),
    boot: { assets: { ...places, "strut_wasm_bg.wasm": engine } },
  };
  const { thread, spawn } = await startEngine(entry, worker, signal);
  return loadEngine(thread, spawn, signal);
}

/** A blob has no folder: its files are looked for beside the page. */
function addressOrPage(): string {
  return /^(blob|data):/.test(import.meta.url) ? document.baseURI : import.meta.url;
}
