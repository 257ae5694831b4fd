/** The foot of the view: what plays, the clock and the length, what is below the pad, and what is done with keys. */
import { button, Segment } from "../controls/buttons";
import { icon } from "../controls/icons";
import { clock, formatNumber, html, setText } from "../dom";
import type { KeyPane, PlayState } from "../state";
import { strings } from "../strings/strings";
import { LENGTH_RANGE } from "./keys";

const words = strings.keyStyle;

export interface FootListeners {
  onPlay: () => void;
  onPrevious: () => void;
  onNext: () => void;
  onLoop: () => void;
  onLength: (secs: number) => void;
  onPane: (pane: KeyPane) => void;
  onReplay: () => void;
  onTrailToKeys: () => void;
  onAddKey: () => void;
  onRemoveKey: () => void;
  onBvh: () => void;
  onGlb: () => void;
}

export class Foot {
  readonly element: HTMLElement;
  readonly #play: HTMLButtonElement;
  readonly #loop: HTMLButtonElement;
  readonly #clock = html("span", { class: "clock" });
  readonly #length = html("input", {
    type: "number",
    class: "length",
    min: LENGTH_RANGE.min,
    max: LENGTH_RANGE.max,
    step: 0.1,
    "aria-label": words.length,
  });
  readonly #pane: Segment<KeyPane>;
  readonly #ofKeys: HTMLButtonElement[];
  readonly #ofTrail: HTMLButtonElement[];
  readonly #remove: HTMLButtonElement;
  readonly #needModel: HTMLButtonElement[];

  constructor(listeners: FootListeners) {
    this.#play = button(words.play, listeners.onPlay, { icon: "play", class: "play", keys: "Space" });
    const previous = button(words.previous, listeners.onPrevious, { icon: "previous", keys: "←" });
    const next = button(words.next, listeners.onNext, { icon: "next", keys: "→" });
    this.#loop = button(words.loop, listeners.onLoop, { icon: "loop", keys: "L" });
    this.#pane = new Segment<KeyPane>(
      words.pane,
      [
        { value: "keys", label: words.keysPane },
        { value: "recordings", label: words.recordingsPane },
      ],
      listeners.onPane,
    );
    const replay = button(words.replay, listeners.onReplay, { icon: "trail", keys: "R" });
    const toKeys = button(words.trailToKeys, listeners.onTrailToKeys, { icon: "key" });
    const add = button(words.addKey, listeners.onAddKey, { icon: "add", label: true, keys: "K" });
    this.#remove = button(words.removeKey, listeners.onRemoveKey, { icon: "remove", keys: "Delete" });
    const outlined = { icon: "export", label: true, class: "outlined" } as const;
    const bvh = button(words.exportBvh, listeners.onBvh, outlined);
    const glb = button(words.exportGlb, listeners.onGlb, outlined);
    this.#ofKeys = [this.#play, previous, next, bvh, glb];
    this.#ofTrail = [replay, toKeys];
    this.#needModel = [...this.#ofKeys, ...this.#ofTrail, this.#loop, add, this.#remove];
    this.element = html(
      "footer",
      { class: "maker-foot" },
      html("div", { class: "maker-transport" }, this.#play, previous, next, this.#loop),
      html(
        "p",
        { class: "maker-time" },
        this.#clock,
        html("span", { class: "caption" }, words.ofLength, " ", this.#length, " ", words.seconds),
      ),
      this.#pane.element,
      html("p", { class: "key-style-hint caption" }, words.drags, " ", html("kbd", {}, "K"), " ", words.setsKey),
      html("div", { class: "maker-actions" }, replay, toKeys, add, this.#remove, bvh, glb),
    );
    this.#length.addEventListener("change", () => {
      const secs = Number(this.#length.value);
      if (this.#length.value !== "" && Number.isFinite(secs))
        listeners.onLength(Math.min(LENGTH_RANGE.max, Math.max(LENGTH_RANGE.min, secs)));
    });
  }

  set secs(secs: number) {
    setText(this.#clock, clock(secs));
  }

  show(state: Readonly<PlayState>, ready: boolean): void {
    const name = state.playing ? words.pause : words.play;
    if (this.#play.getAttribute("aria-label") !== name) {
      this.#play.setAttribute("aria-label", name);
      this.#play.title = `${name} (Space)`;
      this.#play.replaceChildren(icon(state.playing ? "pause" : "play", 18));
    }
    this.#loop.setAttribute("aria-pressed", String(state.loop));
    this.#pane.value = state.keyPane;
    if (document.activeElement !== this.#length)
      this.#length.value = formatNumber(state.keyLength || LENGTH_RANGE.min, 2);
    for (const element of this.#needModel) element.disabled = !ready;
    for (const element of this.#ofKeys) element.disabled ||= state.keys.length === 0;
    for (const element of this.#ofTrail) element.disabled ||= state.keyTrail.length < 2;
    this.#remove.disabled ||= state.keyChosen < 0 || state.keyChosen >= state.keys.length;
  }
}
