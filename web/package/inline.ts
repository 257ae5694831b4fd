/** `strut-motion/inline`: the engine in one file; built-in motions, and what builds and trains, lie beside it. */
import engine from "strut-inline:strut_wasm_bg.wasm";
import workerText from "strut-inline:worker.js";
import { baseAddress, placeIn, placesBy } from "./assets";
import { loadEngine } from "./load";
import * as servers from "./servers";
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
  const places = placesBy((file) => placeIn(folder, file, baseAddress()));
  const entry = {
    workerUrl: undefined,
    workerText: async () => workerText,
    buildWorkerUrl: placeIn(folder, "build_worker.js", baseAddress()),
    servers: async () => servers,
    boot: { assets: { ...places, "strut_wasm_bg.wasm": engine } },
  };
  return loadEngine(entry.boot, await startEngine(entry, worker, signal), signal);
}

/** A blob has no folder: its files are looked for beside the page. */
function addressOrPage(): string {
  return /^(blob|data):/.test(import.meta.url) ? baseAddress() : import.meta.url;
}
