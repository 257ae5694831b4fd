/** Detection of a worker that was terminated from outside, which sends no message. */

interface WatchdogSettings {
  /** How often the limit is checked, milliseconds. */
  stepMs: number;
  /** Time in which messages that have arrived, and an answer to the ping, are handled; milliseconds. */
  graceMs: number;
  /** The longest silence, milliseconds. Asked at each step, since it may depend on the pending calls. */
  limitMs: () => number;
  /** Whether an answer is expected. */
  isWaiting: () => boolean;
  /** Asks the worker for a sign of life. */
  ping: () => void;
  onSilent: () => void;
}

/**
 * Reports a worker that stays silent while an answer is expected. Silence alone is not enough: after the machine slept,
 * or the page was in the browser's history, the timer fires before the messages that have arrived are handled.
 */
export class Watchdog {
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly settings: WatchdogSettings) {}

  /** Starts anew: a call was made, or a message came. */
  restart(): void {
    this.#wait(0);
  }

  stop(): void {
    clearTimeout(this.#timer);
  }

  #wait(silentMs: number): void {
    const { stepMs, graceMs, limitMs, isWaiting, ping, onSilent } = this.settings;
    clearTimeout(this.#timer);
    if (!isWaiting()) return;
    this.#timer = setTimeout(() => {
      if (!isWaiting()) return;
      const silent = silentMs + stepMs;
      if (silent < limitMs()) return this.#wait(silent);
      ping();
      this.#timer = setTimeout(() => {
        if (isWaiting()) onSilent();
      }, graceMs);
    }, stepMs);
  }
}

/** Longest silence of a worker that reads a file in one piece, milliseconds. */
export const READING_MS = 600_000;
