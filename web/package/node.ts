/** `strut-motion` in Node: the engine on the calling thread, in this file; the built-in motions are next to it. */
import engine from "strut-inline:strut_wasm_bg.wasm";
import { cancelled } from "../engine/errors";
import { placeIn, placesBy } from "./assets";
import { placeCharacterFiles } from "./character_files";
import { inflate } from "./inflate";
import { loadEngine } from "./load";
import * as servers from "./servers";
import { localPorts } from "./start";
import type { LoadOptions, Strut } from "./types";

export { StrutError, type StrutErrorCode } from "../engine/errors";
export type * from "./public";

/**
 * Loads the engine. Call `dispose()` when it is no longer needed: until then, its watchdog may keep Node running for
 * some seconds.
 * @throws StrutError `unsupported` if this Node lacks WebAssembly with SIMD, `cancelled`
 */
export async function loadStrut({ assets, signal }: LoadOptions = {}): Promise<Strut> {
  if (signal?.aborted) throw cancelled(signal.reason);
  // Not `new URL(…, import.meta.url)`: server bundlers would look for a module of that name.
  if (assets !== undefined) placeCharacterFiles(assets, import.meta.url);
  const places = placesBy((file) => placeIn(assets ?? "assets", file, import.meta.url));
  const boot = { assets: { ...places, "strut_wasm_bg.wasm": await inflate(engine) } };
  return loadEngine(boot, { thread: "node", ...localPorts(servers) }, signal);
}
