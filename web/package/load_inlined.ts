/** The engine with its module and its worker's script included in one file; the other files are in a folder. */
import engine from "strut-inline:strut_wasm_bg.wasm";
import workerText from "strut-inline:worker.js";
import { baseAddress, type EngineAsset, placeIn, placesBy } from "./assets";
import { inflate } from "./inflate";
import { loadEngine } from "./load";
import { type Servers, startEngine } from "./start";
import type { LoadOptions, Strut } from "./types";

/**
 * Loads the engine.
 * @param folder folder of the files that are not included
 * @param servers servers on the page's thread
 * @param bytes files that the caller already has
 * @throws StrutError `unsupported` if the browser lacks WebAssembly with SIMD, `cancelled`
 */
export async function loadInlined(
  folder: NonNullable<LoadOptions["assets"]>,
  { worker = true, signal }: Omit<LoadOptions, "assets">,
  servers: Servers,
  bytes: Partial<Record<EngineAsset, Uint8Array<ArrayBuffer>>> = {},
): Promise<Strut> {
  const places = placesBy((file) => placeIn(folder, file, baseAddress()));
  const walk = bytes["walk.bin"];
  const given = { ...bytes, ...(walk && { "first.bin": walk }) };
  const entry = {
    workerUrl: undefined,
    workerText: async () => workerText,
    buildWorkerUrl: placeIn(folder, "build_worker.js", baseAddress()),
    servers: async () => servers,
    boot: { assets: { ...places, "strut_wasm_bg.wasm": await inflate(engine), ...given } },
  };
  return loadEngine(entry.boot, await startEngine(entry, worker, signal), signal);
}
