/** The WASM package that walks: loaded with the Walk view, and by nobody else. */
import { StrutError, toStrutError } from "../errors";
import { compileModule } from "../module";
import * as glue from "./pkg/strut_wasm_walk.js";

/** The generated bindings. */
export type WalkGlue = typeof glue;

let loading: Promise<WalkGlue> | undefined;
let memory: WebAssembly.Memory;

/**
 * The bindings, loaded once for a thread.
 * @throws StrutError if the module cannot be had
 */
export function loadWalkWasm(): Promise<WalkGlue> {
  loading ??= instantiate().catch((thrown) => {
    loading = undefined;
    throw toStrutError(thrown);
  });
  return loading;
}

/** Runs a call into the module. A string that it throws is a sentence about an argument; anything else a fault. */
export function guarded<T>(call: () => T): T {
  try {
    return call();
  } catch (thrown) {
    if (typeof thrown !== "string") throw toStrutError(thrown);
    const message = `${thrown.charAt(0).toUpperCase()}${thrown.slice(1)}.`;
    throw new StrutError({ code: "bad-input", message, hint: "" });
  }
}

/** Numbers in the module's memory, which may move when anything is allocated: not to be kept. */
export function floatsAt(address: number, length: number): Float32Array {
  return new Float32Array(memory.buffer, address, length);
}

async function instantiate(): Promise<WalkGlue> {
  const module = await compileModule(new URL("./pkg/strut_wasm_walk_bg.wasm", import.meta.url));
  memory = glue.initSync({ module }).memory;
  return glue;
}
