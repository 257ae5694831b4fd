/** The footer of the view: transport, clock and length, the choice of the timeline, and edits of keys. */

import { button, Segment } from "../../../ui/controls/buttons";
import { clock, formatNumber, html, setText } from "../../../ui/dom";
import { type KeyPane, LENGTH_RANGE } from "../../state/key_style";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { Transport, type TransportListeners } from "../synthesis/transport";
import { fitted } from "./keys";

const words = strings.keyStyle;

interface FooterListeners extends TransportListeners {
  onReplay: () => void;
  onTrailToKeys: () => void;
  onAddKey: () => void;
  onRemoveKey: () => void;
  onBvh: () => void;
  onGlb: () => void;
}

export class Footer {
  readonly element: HTMLElement;
  readonly #transport: Transport;
  readonly #clock = html("span", { class: "clock" });
  readonly #length = html("input", {
    type: "number",
    class: "length",
    min: LENGTH_RANGE.min,
    max: LENGTH_RANGE.max,
    // Displayed with two decimals: coarser steps would make it invalid.
    step: 0.01,
    "aria-label": words.length,
  });
  readonly #pane: Segment<KeyPane>;
  readonly #ofKeys: HTMLButtonElement[];
  readonly #ofTrail: HTMLButtonElement[];
  readonly #remove: HTMLButtonElement;
  readonly #needModel: HTMLButtonElement[];

  constructor(store: Store, listeners: FooterListeners) {
    this.#transport = new Transport(store, words, listeners);
    this.#pane = new Segment<KeyPane>(
      words.pane,
      [
        { value: "keys", label: words.keysPane },
        { value: "recordings", label: words.recordingsPane },
      ],
      (keyPane) => store.edit({ keyPane }),
    );
    const replay = button(words.replay, listeners.onReplay, { icon: "trail", keys: "R" });
    const toKeys = button(words.trailToKeys, listeners.onTrailToKeys, { icon: "key" });
    const add = button(words.addKey, listeners.onAddKey, { icon: "add", label: true, keys: "K" });
    add.setAttribute("aria-label", words.setKey);
    this.#remove = button(words.removeKey, listeners.onRemoveKey, { icon: "remove", keys: "Delete" });
    const outlined = { icon: "export", label: true, class: "outlined" } as const;
    const bvh = button(strings.synthesis.exportBvh, listeners.onBvh, outlined);
    const glb = button(strings.synthesis.exportGlb, listeners.onGlb, outlined);
    this.#ofKeys = [...this.#transport.buttons, bvh, glb];
    this.#ofTrail = [replay, toKeys];
    this.#needModel = [...this.#ofKeys, ...this.#ofTrail, this.#transport.loop, add, this.#remove];
    this.element = html(
      "footer",
      { class: "editor-foot" },
      this.#transport.element,
      html(
        "p",
        { class: "editor-time" },
        this.#clock,
        html("span", { class: "caption" }, words.ofLength, " ", this.#length, " ", words.seconds),
      ),
      this.#pane.element,
      html("p", { class: "key-style-hint caption" }, words.drags, " ", html("kbd", {}, "K"), " ", words.setsKey),
      html("div", { class: "editor-actions" }, replay, toKeys, add, this.#remove, bvh, glb),
    );
    this.#length.addEventListener("change", () => {
      const secs = Number(this.#length.value);
      if (this.#length.value === "" || !Number.isFinite(secs)) return;
      const keyLength = Math.min(LENGTH_RANGE.max, Math.max(LENGTH_RANGE.min, secs));
      store.edit({ keyLength, keys: fitted(store.state.keys, keyLength) });
    });
  }

  set secs(secs: number) {
    setText(this.#clock, clock(secs));
  }

  show(state: Readonly<AppState>, ready: boolean): void {
    this.#transport.show(state);
    this.#pane.value = state.keyPane;
    if (document.activeElement !== this.#length)
      this.#length.value = formatNumber(state.keyLength || LENGTH_RANGE.min, 2);
    for (const element of this.#needModel) element.disabled = !ready;
    for (const element of this.#ofKeys) element.disabled ||= state.keys.length === 0;
    for (const element of this.#ofTrail) element.disabled ||= state.keyTrail.length < 2;
    this.#remove.disabled ||= state.keyChosen < 0 || state.keyChosen >= state.keys.length;
  }
}
