/** The setting for single-character shortcuts (WCAG 2.1.4): speech input and tremor trigger them by accident. */

/** Key in localStorage. */
const STORAGE_KEY = "strut.singleKeys";

export class SingleKeys {
  readonly #memory: () => Pick<Storage, "getItem" | "setItem">;
  #on = true;

  /** If storage is refused, as in a private window, the setting lasts as long as the page. */
  constructor(memory: () => Pick<Storage, "getItem" | "setItem"> = () => localStorage) {
    this.#memory = memory;
    try {
      this.#on = memory().getItem(STORAGE_KEY) !== "off";
    } catch {
      // The default is kept.
    }
  }

  get on(): boolean {
    return this.#on;
  }

  set on(on: boolean) {
    this.#on = on;
    try {
      this.#memory().setItem(STORAGE_KEY, on ? "on" : "off");
    } catch {
      // The setting lasts as long as the page.
    }
  }
}
