/** Loads a WASM module, in a browser and in Node. */
import type { Asset } from "./assets";
import { download, readAsset } from "./download";
import { StrutError } from "./errors";

/** A module whose only function uses 128-bit SIMD. */
const SIMD_MODULE = new Uint8Array([
  ...[0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0],
  ...[10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11],
]);

/**
 * Compiles the module at a URL, or of these bytes.
 * @param what name of the module in messages
 * @throws StrutError `unsupported` if WebAssembly or its SIMD instructions are missing, `load` if the module cannot be
 * loaded
 */
export async function compileModule(asset: Asset, what = "engine"): Promise<WebAssembly.Module> {
  requireSimd();
  if (!(asset instanceof URL)) return WebAssembly.compile(asset);
  if (asset.protocol === "file:") return WebAssembly.compile(await readAsset(asset, what));
  const response = await download(asset, what);
  const type = response.headers.get("Content-Type") ?? "";
  // Some static hosts do not send the MIME type that streaming compilation requires.
  return type.startsWith("application/wasm")
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

/** Without this check the module would fail to compile, which looks like a bug in Strut. */
function requireSimd(): void {
  if (typeof WebAssembly === "object" && WebAssembly.validate(SIMD_MODULE)) return;
  throw new StrutError({
    code: "unsupported",
    message: "This browser cannot run Strut's engine: it lacks WebAssembly with SIMD.",
    hint: "Use a current Chrome, Edge, Firefox or Safari.",
  });
}
