/** Three hints for new users, one at a time; a hint that was followed is not shown again. */
import { strings } from "../../strings/strings";

/** In the order of display. */
const NAMES = ["drag", "part", "key"] as const;

/** Name of a hint. */
type HintName = (typeof NAMES)[number];

/** Key in localStorage. */
const STORAGE_KEY = "strut.hints";

/** The part of `Storage` that is used. */
type Memory = Pick<Storage, "getItem" | "setItem">;

export class Hints {
  readonly #memory: () => Memory;
  readonly #followed: Set<string>;

  /** If storage is refused, as in a private window, the hints are shown again. */
  constructor(memory: () => Memory = () => localStorage) {
    this.#memory = memory;
    let followed = "";
    try {
      followed = memory().getItem(STORAGE_KEY) ?? "";
    } catch {
      // The hint is shown again next time.
    }
    this.#followed = new Set(followed.split(" "));
  }

  /** The current hint; empty once all were followed. */
  get text(): string {
    const next = NAMES.find((name) => !this.#followed.has(name));
    return next ? strings.play.hints[next] : "";
  }

  /** Marks a hint as followed, whether it was shown or not. */
  follow(name: HintName): void {
    if (this.#followed.has(name)) return;
    this.#followed.add(name);
    try {
      this.#memory().setItem(STORAGE_KEY, [...this.#followed].filter(Boolean).join(" "));
    } catch {
      // The hints start again.
    }
  }
}
