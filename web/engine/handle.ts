/** Ownership of objects in a module's memory, which must be freed. */
import { disposed } from "./errors";

/** Owner of one object of the WASM package. `dispose()` frees it; a second call does nothing. */
export abstract class Handle<T extends { free(): void }> {
  #owned: T | undefined;

  /** @param what noun for messages */
  protected constructor(
    owned: T,
    private readonly what: string,
  ) {
    this.#owned = owned;
  }

  /**
   * The object itself, for other handles of the engine.
   * @throws StrutError after `dispose()`
   */
  get raw(): T {
    if (!this.#owned) throw disposed(this.what);
    return this.#owned;
  }

  dispose(): void {
    const owned = this.#owned;
    this.#owned = undefined;
    try {
      owned?.free();
    } catch {
      // The instance that held it was lost with all its memory.
    }
  }
}
