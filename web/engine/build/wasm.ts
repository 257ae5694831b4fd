/** The WASM package that builds databases: loaded by those who bring their own clips, and by nobody else. */
import { StrutError, toStrutError } from "../errors";
import { compileModule } from "../module";
import * as glue from "./pkg/strut_wasm_build.js";

/** The generated bindings. */
export type BuildGlue = typeof glue;

/** Where the module is. */
export const BUILD_MODULE = new URL("./pkg/strut_wasm_build_bg.wasm", import.meta.url);

let loading: Promise<BuildGlue> | undefined;
let memory: WebAssembly.Memory;

/**
 * The bindings, loaded once for a thread.
 * @throws StrutError if the module cannot be had
 */
export function loadBuildWasm(): Promise<BuildGlue> {
  loading ??= instantiate().catch((thrown) => {
    loading = undefined;
    throw toStrutError(thrown);
  });
  return loading;
}

/** Runs a call into the module. A string that it throws is a sentence about the caller's file; anything else a fault. */
export function guarded<T>(call: () => T): T {
  try {
    return call();
  } catch (thrown) {
    if (typeof thrown === "string") throw new StrutError({ code: "bad-file", message: sentence(thrown), hint: "" });
    throw toStrutError(thrown);
  }
}

/** Rust's messages begin small and end without a full stop. */
export function sentence(message: string): string {
  const ended = /[.!?]$/.test(message) ? message : `${message}.`;
  return ended.charAt(0).toUpperCase() + ended.slice(1);
}

/** A copy of a part of the module's memory as a file, without a second one on the way there. */
export function fileAt(address: number, length: number): Blob {
  return new Blob([new Uint8Array(memory.buffer as ArrayBuffer, address, length)]);
}

async function instantiate(): Promise<BuildGlue> {
  const module = await compileModule(BUILD_MODULE);
  memory = glue.initSync({ module }).memory;
  return glue;
}
