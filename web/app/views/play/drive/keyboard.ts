/** Driving with the keyboard: keys by their position, so that WASD works on every layout. */
import type { Wish } from "./wish";

/** Direction of each key: right in the picture, and away from the viewer. */
const WAYS: Readonly<Record<string, readonly [right: number, ahead: number]>> = {
  KeyW: [0, 1],
  KeyA: [-1, 0],
  KeyS: [0, -1],
  KeyD: [1, 0],
  ArrowUp: [0, 1],
  ArrowLeft: [-1, 0],
  ArrowDown: [0, -1],
  ArrowRight: [1, 0],
};
const RUN = ["ShiftLeft", "ShiftRight"];

/** Actions of keys when they are pressed. */
export type Presses = Readonly<Record<string, () => void>>;

/** Elements that keep keys for themselves while focused. */
const OWN_KEYS = "input:not([type=checkbox]), select, textarea, [contenteditable], [role=slider], [role=tab]";
const OWN_SPACE = "button, a, summary, [role=button], [role=switch]";

export class Keyboard {
  /** Whether a released direction is kept until another one, or the same, is pressed. */
  latches = false;
  readonly #held = new Set<string>();
  #latched: Wish | undefined;

  /**
   * @param presses actions by `KeyboardEvent.code`
   * @param singleKeys whether single-character shortcuts are on
   * @param onUse called when a steering key is pressed
   */
  constructor(presses: () => Presses, singleKeys: () => boolean, onUse: () => void, signal: AbortSignal) {
    const onDown = (event: KeyboardEvent): void => {
      if (!isFree(event) || (event.code.startsWith("Key") && !singleKeys())) return;
      const press = presses()[event.code];
      if (!(event.code in WAYS) && !press && !RUN.includes(event.code)) return;
      if (!RUN.includes(event.code)) {
        event.preventDefault();
        // The page and the camera use some of these keys otherwise.
        event.stopPropagation();
      }
      if (event.repeat) return;
      if (!RUN.includes(event.code)) onUse();
      press?.();
      const before = this.#latched;
      this.#held.add(event.code);
      this.#latched = this.latches && event.code in WAYS ? this.#pressed() : before;
      const isSame = before && this.#held.size === 1 && same(before, this.#latched);
      if (isSame) this.stop();
    };
    addEventListener("keydown", onDown, { signal, capture: true });
    addEventListener("keyup", ({ code }) => this.#held.delete(code), { signal, capture: true });
    // macOS sends no keyup for a key released while Command is held.
    addEventListener("keydown", ({ key }) => key === "Meta" && this.stop(), { signal, capture: true });
    addEventListener("blur", () => this.stop(), { signal });
    document.addEventListener("visibilitychange", () => document.hidden && this.stop(), { signal });
  }

  /** The input of the keys; `undefined` if none is pressed. */
  get wish(): Wish | undefined {
    return this.#pressed() ?? (this.latches ? this.#latched : undefined);
  }

  /** Releases all keys. */
  stop(): void {
    this.#held.clear();
    this.#latched = undefined;
  }

  #pressed(): Wish | undefined {
    let [right, ahead] = [0, 0];
    for (const code of this.#held) {
      right += WAYS[code]?.[0] ?? 0;
      ahead += WAYS[code]?.[1] ?? 0;
    }
    const length = Math.hypot(right, ahead);
    if (length === 0) return undefined;
    const gait = RUN.some((code) => this.#held.has(code)) ? 2 : 1;
    return { right: right / length, ahead: ahead / length, gait };
  }
}

const same = (a: Wish, b: Wish | undefined): boolean =>
  a.right === b?.right && a.ahead === b.ahead && a.gait === b.gait;

/** Whether nothing else handles a key. */
function isFree(event: KeyboardEvent): boolean {
  if (event.altKey || event.ctrlKey || event.metaKey || document.querySelector("dialog[open]")) return false;
  const focused = event.target instanceof Element ? event.target : null;
  return !focused?.matches(event.code === "Space" ? `${OWN_KEYS}, ${OWN_SPACE}` : OWN_KEYS);
}
