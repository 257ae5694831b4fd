/** The task in which synchronous WebGL calls are allowed, as the GPU has nothing to do. */
export class IdleTurn {
  #state: "allowed" | "waiting" | "none" = "none";

  /** Whether the GPU is being awaited. */
  get isWaiting(): boolean {
    return this.#state === "waiting";
  }

  /** Whether synchronous calls are allowed in this task. */
  get isAllowed(): boolean {
    return this.#state === "allowed";
  }

  /** Calls `then` when the GPU is idle. Afterwards, or if one of the two fails, nothing is awaited or allowed any more. */
  async take(idle: () => Promise<void>, then: () => void): Promise<void> {
    this.#state = "waiting";
    try {
      await idle();
      this.#state = "allowed";
      then();
    } finally {
      this.#state = "none";
    }
  }
}
