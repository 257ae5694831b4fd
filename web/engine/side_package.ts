/** WASM packages other than the engine's, each loaded when it is first needed. */
import type { Asset } from "./assets";
import { toStrutError } from "./errors";
import { loadedOnce } from "./loaded_once";
import { compileModule } from "./module";
import { type ErrorClass, valueError } from "./value_error";

/** The part of wasm-bindgen's output that every package has. */
interface Bindings extends ErrorClass {
  initSync: (source: { module: WebAssembly.Module }) => unknown;
}

/** A package, loaded once per thread. */
export class SidePackage<Glue extends Bindings> {
  /** @param module location of the module */
  constructor(
    private readonly glue: Glue,
    private readonly module: () => Asset,
  ) {}

  /**
   * The bindings.
   * @throws StrutError if the module cannot be loaded
   */
  readonly load = loadedOnce(() => this.awaited(() => this.#instantiate()));

  /**
   * Runs a call into the module. An error that the module returns as a value is a {@link StrutError}; anything else is
   * a fault.
   */
  guarded<T>(call: () => T): T {
    try {
      return call();
    } catch (thrown) {
      throw valueError(this.glue, thrown) ?? toStrutError(thrown);
    }
  }

  /** Runs an asynchronous call, with the same errors. */
  async awaited<T>(call: () => Promise<T>): Promise<T> {
    try {
      return await call();
    } catch (thrown) {
      throw valueError(this.glue, thrown) ?? toStrutError(thrown);
    }
  }

  async #instantiate(): Promise<Glue> {
    this.glue.initSync({ module: await compileModule(this.module()) });
    return this.glue;
  }
}
