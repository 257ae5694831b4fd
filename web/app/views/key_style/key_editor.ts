/** Edits of the keys at the playhead: by buttons, by the keyboard and on the timelines. */
import { MAX_KEYS, type TimedValue } from "../../state/key_style";
import type { Store } from "../../state/store";
import { removeKey, setKey } from "./keys";
import type { Player } from "./player";
import { keysOf, lengthOf } from "./trail";

/** Distance of the keys made from a drag, seconds: ten frames of the training data. */
const TRAIL_KEYS_SECS = 1 / 3;
/** Keys within this distance of the playhead count as at it, seconds. */
const AT_PLAYHEAD_SECS = 1e-3;
/** Shortest animation made from a drag, seconds. */
const MIN_TRAIL_SECS = 0.5;

export class KeyEditor {
  readonly #store: Store;
  readonly #player: Player;
  readonly #onTooMany: () => void;

  /** `onTooMany` is called at the maximum number of keys. */
  constructor(store: Store, player: Player, onTooMany: () => void) {
    this.#store = store;
    this.#player = player;
    this.#onTooMany = onTooMany;
  }

  /** The keys that can be edited: none while a model with other variables is trained. */
  get keys(): readonly TimedValue[] {
    return this.#player.ready ? this.#store.state.keys : [];
  }

  choose(keyChosen: number): void {
    const key = this.keys[keyChosen];
    if (!key) return;
    this.#store.edit({ keyChosen, playing: false });
    this.#player.seek(key.secs);
  }

  /** Selects the next key after the playhead, or before it; after the last one comes the first. */
  chooseNext(direction: 1 | -1): void {
    const { keys } = this;
    const { secs } = this.#player;
    const next =
      direction > 0
        ? keys.findIndex((key) => key.secs > secs + AT_PLAYHEAD_SECS)
        : keys.findLastIndex((key) => key.secs < secs - AT_PLAYHEAD_SECS);
    this.choose(next >= 0 ? next : direction > 0 ? 0 : keys.length - 1);
  }

  /** Sets a key at the playhead, with the handle's values. */
  add(): void {
    if (!this.#player.ready) return;
    const { keys: before, keyHandle, keyLength } = this.#store.state;
    const secs = Math.min(keyLength, Math.round(this.#player.secs * 100) / 100);
    const { keys, key } = setKey(before, secs, keyHandle);
    if (key < 0) {
      this.#onTooMany();
      return;
    }
    this.#store.edit({ keys, keyChosen: key, playing: false });
    this.#player.seek(keys[key]!.secs);
  }

  /** Removes the selected key. */
  remove(): void {
    const { keys, keyChosen } = this.#store.state;
    if (keyChosen < 0 || keyChosen >= keys.length) return;
    this.#store.edit({ keys: removeKey(keys, keyChosen), keyChosen: Math.min(keyChosen, keys.length - 2) });
  }

  /** Converts the last drag to keys. */
  takeTrail(): void {
    const { keyTrail } = this.#store.state;
    const keys = keysOf(keyTrail, TRAIL_KEYS_SECS, MAX_KEYS);
    const keyLength = Math.max(MIN_TRAIL_SECS, lengthOf(keyTrail));
    this.#store.edit({ keys, keyChosen: -1, keyLength, playing: true });
    this.#player.seek(0);
  }
}
