/** Runs a task once the GPU is idle. Only this task may make synchronous WebGL calls, which then return at once. */
export class IdleTask {
  #state: "allowed" | "waiting" | "none" = "none";

  /** Whether the GPU is being awaited. */
  get isWaiting(): boolean {
    return this.#state === "waiting";
  }

  /** Whether synchronous calls are allowed in this task. */
  get isAllowed(): boolean {
    return this.#state === "allowed";
  }

  /** Calls `then` when the GPU is idle. Afterwards, or if either fails, no synchronous call is allowed. */
  async run(idle: () => Promise<void>, then: () => void): Promise<void> {
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
