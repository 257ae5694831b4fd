/** Three hints for the first minute, one at a time; each goes once it has been followed, for good. */
import { strings } from "./strings/strings";

/** In the order in which they come. */
const NAMES = ["drag", "part", "key"] as const;

/** What a hint is about. */
export type HintName = (typeof NAMES)[number];

/** Where it is remembered which hints were followed. */
const STORAGE_KEY = "strut.hints";

/** As much of the browser's storage as is needed. */
type Memory = Pick<Storage, "getItem" | "setItem">;

export class Hints {
  readonly #memory: () => Memory;
  readonly #followed: Set<string>;

  /** Storage may be refused, as in a private window; then the hints come again. */
  constructor(memory: () => Memory = () => localStorage) {
    this.#memory = memory;
    let followed = "";
    try {
      followed = memory().getItem(STORAGE_KEY) ?? "";
    } catch {
      // Nothing depends on it.
    }
    this.#followed = new Set(followed.split(" "));
  }

  /** The present hint; empty once all were followed. */
  get text(): string {
    const next = NAMES.find((name) => !this.#followed.has(name));
    return next ? strings.play.hints[next] : "";
  }

  /** A person did what a hint says, whether they read it or not. */
  follow(name: HintName): void {
    if (this.#followed.has(name)) return;
    this.#followed.add(name);
    try {
      this.#memory().setItem(STORAGE_KEY, [...this.#followed].filter(Boolean).join(" "));
    } catch {
      // As above.
    }
  }
}
