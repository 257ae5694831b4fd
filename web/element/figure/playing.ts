/** A button that plays a figure's motion, and where the motion stands between two frames. */
import { icon } from "../../ui/controls/icons";
import { html } from "../../ui/dom";
import type { Words } from "./words/words";

export class Playing {
  readonly element = html("button", { type: "button", class: "button" });
  readonly #words: Words;
  #playing = false;
  #at = 0;

  /** @param onPause somebody has stopped it: what is shown stays */
  constructor(words: Words, onPause: () => void, signal: AbortSignal) {
    this.#words = words;
    const toggle = () => {
      this.#playing = !this.#playing;
      this.#show();
      if (!this.#playing) onPause();
    };
    this.element.addEventListener("click", toggle, { signal });
    this.#show();
  }

  /** The frame that a state says; while it plays, only a far one is gone to. */
  set frame(frame: number) {
    if (!this.#playing || Math.abs(frame - this.#at) > 1) this.#at = frame;
  }

  /** The frame after a time, from the first again after the last; `undefined` while it stands. */
  advance(dtSecs: number, rateHz: number, last: number): number | undefined {
    if (!this.#playing) return undefined;
    this.#at = this.#at >= last ? 0 : Math.min(last, this.#at + dtSecs * rateHz);
    return Math.floor(this.#at);
  }

  #show(): void {
    const name = this.#words[this.#playing ? "pause" : "play"];
    this.element.setAttribute("aria-label", name);
    this.element.replaceChildren(icon(this.#playing ? "pause" : "play"), html("span", {}, name));
  }
}
