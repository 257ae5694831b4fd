/** Loads a WASM module, in a browser and in Node. */
import { StrutError } from "./errors";

/**
 * The compiled module at a URL.
 * @throws StrutError if it cannot be had
 */
export function compileModule(url: URL): Promise<WebAssembly.Module> {
  return url.protocol === "file:" ? fromFile(url) : fromNetwork(url);
}

async function fromFile(url: URL): Promise<WebAssembly.Module> {
  // Node only; the bundler must not look for it.
  const fs: typeof import("node:fs/promises") = await import(/* @vite-ignore */ `node:${"fs/promises"}`);
  return WebAssembly.compile(new Uint8Array(await fs.readFile(url)));
}

async function fromNetwork(url: URL): Promise<WebAssembly.Module> {
  const response = await fetch(url);
  if (!response.ok) {
    throw new StrutError({
      code: "bad-file",
      message: `The engine could not be loaded: the server answered ${response.status} for ${url.pathname}.`,
      hint: "Reload the page; if that does not help, the site was not deployed completely.",
    });
  }
  const type = response.headers.get("Content-Type") ?? "";
  // Some static hosts do not know the type that streaming compilation insists on.
  return type.startsWith("application/wasm")
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}
