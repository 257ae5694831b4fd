/** A value that several users share: made for the first of them, and closed a while after the last one has released it. */

/** A use of a shared value. */
export interface Lease<T> {
  readonly value: T;
  /** Ends the use; only the first call counts. */
  release(): void;
}

export class Lingering<T> {
  readonly #lingerMs: number;
  readonly #make: () => T;
  readonly #close: (value: T) => void;
  #made: { value: T } | undefined;
  #users = 0;
  #closing: ReturnType<typeof setTimeout> | undefined;

  /** @param lingerMs how long it stays open without users: pages remove elements and insert them again */
  constructor(lingerMs: number, make: () => T, close: (value: T) => void) {
    this.#lingerMs = lingerMs;
    this.#make = make;
    this.#close = close;
  }

  lease(): Lease<T> {
    clearTimeout(this.#closing);
    this.#made ??= { value: this.#make() };
    this.#users += 1;
    let isReleased = false;
    const release = () => {
      if (isReleased) return;
      isReleased = true;
      this.#users -= 1;
      if (this.#users === 0) this.#closing = setTimeout(() => this.#end(), this.#lingerMs);
    };
    return { value: this.#made.value, release };
  }

  #end(): void {
    const made = this.#made;
    this.#made = undefined;
    if (made) this.#close(made.value);
  }
}
