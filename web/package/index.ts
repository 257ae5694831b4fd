/** `strut-motion` in a browser: the engine in a worker, its files next to this one. */
import { download } from "../engine/download";
import { StrutError } from "../engine/errors";
import { baseAddress, placeIn, placesBy } from "./assets";
import { placeCharacterFiles } from "./character_files";
import { loadEngine } from "./load";
import { startEngine } from "./start";
import type { LoadOptions, Strut } from "./types";

export { StrutError, type StrutErrorCode } from "../engine/errors";
export type * from "./public";

/**
 * Loads the engine.
 * @throws StrutError `load` if a file is missing, `unsupported` if the browser lacks WebAssembly with SIMD, `cancelled`
 */
export async function loadStrut({ assets, worker = true, signal }: LoadOptions = {}): Promise<Strut> {
  const place = assets === undefined ? beside() : (file: string) => placeIn(assets, file, baseAddress());
  if (assets !== undefined) placeCharacterFiles(assets, baseAddress());
  const workerUrl = place("worker.js");
  const entry = {
    workerUrl,
    workerText: async () => (await download(new URL(workerUrl), "engine")).text(),
    buildWorkerUrl: place("build_worker.js"),
    servers: () => import("./servers"),
    boot: { assets: placesBy(place) },
  };
  return loadEngine(entry.boot, await startEngine(entry, worker, signal), signal);
}

/** Each URL is in the form that bundlers recognise. @throws StrutError `load` if this file has no URL */
function beside(): (file: string) => string {
  try {
    const places: Record<string, string> = {
      "worker.js": new URL("./assets/worker.js", import.meta.url).href,
      "build_worker.js": new URL("./assets/build_worker.js", import.meta.url).href,
      "strut_wasm_bg.wasm": new URL("./assets/strut_wasm_bg.wasm", import.meta.url).href,
      "strut_wasm_build_bg.wasm": new URL("./assets/strut_wasm_build_bg.wasm", import.meta.url).href,
      "strut_wasm_walk_bg.wasm": new URL("./assets/strut_wasm_walk_bg.wasm", import.meta.url).href,
      "strut_wasm_key_style_bg.wasm": new URL("./assets/strut_wasm_key_style_bg.wasm", import.meta.url).href,
      "strut_live_bg.wasm": new URL("./assets/strut_live_bg.wasm", import.meta.url).href,
      "walk.bin": new URL("./assets/walk.bin", import.meta.url).href,
      "built_in.bin": new URL("./assets/built_in.bin", import.meta.url).href,
    };
    // Turbopack returns a path where other bundlers return an absolute URL.
    return (file) => new URL(places[file]!, baseAddress()).href;
  } catch (cause) {
    const message =
      "The location of the engine's files is unknown, because this module was loaded from a blob: or data: URL.";
    const hint = "Import 'strut-motion/inline', or set the location of the files: loadStrut({ assets }).";
    throw new StrutError({ code: "load", message, hint }, cause);
  }
}
