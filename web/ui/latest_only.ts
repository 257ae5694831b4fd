/**
 * Runs work for the last of the states that arrive while it is busy: a drag produces more of them than the engine can
 * answer.
 */

export class LatestOnly<State> {
  readonly #work: (state: State) => Promise<void>;
  #next: { state: State; done: Promise<void> } | undefined;
  #running: Promise<void> | undefined;

  constructor(work: (state: State) => Promise<void>) {
    this.#work = work;
  }

  /** Adds a state. Resolves when the work is done for it, or for a later one. */
  take(state: State): Promise<void> {
    if (!this.#running) return this.#run(state);
    if (this.#next) {
      this.#next.state = state;
      return this.#next.done;
    }
    // A failure for one state need not affect the next.
    const done = this.#running.catch(() => {}).then(() => this.#runNext());
    this.#next = { state, done };
    return done;
  }

  #run(state: State): Promise<void> {
    const running = this.#work(state).finally(() => {
      if (this.#running === running) this.#running = undefined;
    });
    this.#running = running;
    return running;
  }

  #runNext(): Promise<void> {
    const { state } = this.#next!;
    this.#next = undefined;
    return this.#run(state);
  }
}
