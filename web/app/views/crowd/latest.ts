/** Sends values that change faster than they are taken: the last one of those that came meanwhile is sent next. */
export class Latest<T> {
  readonly #send: (value: T) => Promise<void>;
  #busy = false;
  #waiting: { value: T } | undefined;

  constructor(send: (value: T) => Promise<void>) {
    this.#send = send;
  }

  /** Sends a value, at once or as soon as the one before is taken. */
  push(value: T): void {
    this.#waiting = { value };
    if (!this.#busy) void this.#flush();
  }

  async #flush(): Promise<void> {
    this.#busy = true;
    while (this.#waiting) {
      const { value } = this.#waiting;
      this.#waiting = undefined;
      await this.#send(value);
    }
    this.#busy = false;
  }
}
