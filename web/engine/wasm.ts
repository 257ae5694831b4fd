/** The WASM package that styles motion, loaded once per thread: `whole.ts`, or a package with more or fewer functions. */

import type { Asset } from "./assets";
import { StrutError, toStrutError } from "./errors";
import { loadedOnce } from "./loaded_once";
import { compileModule } from "./module";
import type * as engineGlue from "./pkg/strut_wasm.js";
import { valueError } from "./value_error";

/** The generated bindings. */
export type Glue = typeof engineGlue;

let glue: Glue;
let module: () => Asset;

let compiled: WebAssembly.Module | undefined;
let lost = false;

/** Makes this thread use a package. Call it before anything is loaded. */
export function servePackage(its: Glue, itsModule: () => Asset): void {
  glue = its;
  module = itsModule;
}

/**
 * The bindings, loaded once per thread. After a fault ({@link guarded}) a fresh instance replaces the lost one; objects
 * of the lost instance cannot be used.
 * @throws StrutError if the module cannot be loaded
 */
export async function loadWasm(): Promise<Glue> {
  await instantiated().catch((thrown) => {
    throw toStrutError(thrown);
  });
  if (lost) {
    glue.__wbg_reset_state();
    lost = false;
  }
  return glue;
}

/**
 * Runs a call into the module. An error that the module returns as a value is thrown as a {@link StrutError}. Anything
 * else is a fault, after which the instance takes no more calls.
 */
export function guarded<T>(call: () => T): T {
  if (lost) throw toStrutError(new Error("it failed before and was not loaded again"));
  try {
    return call();
  } catch (thrown) {
    const error = thrown instanceof StrutError ? thrown : valueError(glue, thrown);
    if (error) throw error;
    lost = true;
    throw toStrutError(thrown);
  }
}

/** Size of the instance's linear memory, bytes; 0 before it is loaded. */
export function wasmBytes(): number {
  // Once there is an instance, `initSync` returns its exports, also after a reset.
  return compiled ? glue.initSync({ module: compiled }).memory.buffer.byteLength : 0;
}

const instantiated = loadedOnce(async () => {
  const loaded = await compileModule(module());
  glue.initSync({ module: loaded });
  compiled = loaded;
});
