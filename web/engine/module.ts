/** Loads a WASM module, in a browser and in Node. */
import { download, readFile } from "./download";

/**
 * The compiled module at a URL.
 * @throws StrutError if it cannot be had
 */
export async function compileModule(url: URL): Promise<WebAssembly.Module> {
  if (url.protocol === "file:") return WebAssembly.compile(await readFile(url));
  const response = await download(url, "engine");
  const type = response.headers.get("Content-Type") ?? "";
  // Some static hosts do not know the type that streaming compilation insists on.
  return type.startsWith("application/wasm")
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}
