/** WASM packages beside the engine's, each loaded by those who need it and by nobody else. */
import { StrutError, type StrutErrorCode, toStrutError } from "./errors";
import { compileModule } from "./module";

/** What wasm-bindgen makes of any package. */
interface Bindings {
  initSync: (source: { module: WebAssembly.Module }) => { readonly memory: WebAssembly.Memory };
}

/** A package, loaded once for a thread. A string that it throws says what is wrong with an argument. */
export class SidePackage<Glue extends Bindings> {
  #loading: Promise<Glue> | undefined;
  #memory: WebAssembly.Memory | undefined;

  /**
   * @param module where it is
   * @param code what a string that it throws is
   */
  constructor(
    private readonly glue: Glue,
    private readonly module: URL,
    private readonly code: StrutErrorCode,
  ) {}

  /**
   * The bindings.
   * @throws StrutError if the module cannot be had
   */
  load(): Promise<Glue> {
    this.#loading ??= this.#instantiate().catch((thrown) => {
      this.#loading = undefined;
      throw toStrutError(thrown);
    });
    return this.#loading;
  }

  /** The memory's bytes now; not to be kept, for it may grow. */
  get bytes(): ArrayBuffer {
    return this.#memory!.buffer as ArrayBuffer;
  }

  /** Runs a call into the module; anything but a string that it throws is a fault. */
  guarded<T>(call: () => T): T {
    try {
      return call();
    } catch (thrown) {
      if (typeof thrown !== "string") throw toStrutError(thrown);
      throw new StrutError({ code: this.code, message: sentence(thrown), hint: "" });
    }
  }

  async #instantiate(): Promise<Glue> {
    this.#memory = this.glue.initSync({ module: await compileModule(this.module) }).memory;
    return this.glue;
  }
}

/** Rust's messages begin small and end without a full stop. */
export function sentence(message: string): string {
  const ended = /[.!?]$/.test(message) ? message : `${message}.`;
  return ended.charAt(0).toUpperCase() + ended.slice(1);
}
