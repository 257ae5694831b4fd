/** A button that plays a figure's motion, and the position of the motion between two frames. */
import { icon } from "../ui/controls/icons";
import { html } from "../ui/dom";
import type { Words } from "./words/words";

export class Playing {
  readonly element = html("button", { type: "button", class: "button" });
  readonly #words: Words;
  #playing = false;
  #at = 0;

  /** @param onPause called when the user pauses: the displayed frame stays */
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

  /** The frame of the state; during playback it jumps only to a distant one. */
  set frame(frame: number) {
    if (!this.#playing || Math.abs(frame - this.#at) > 1) this.#at = frame;
  }

  /** Advances by a duration and returns the frame, looping after the last one; `undefined` while paused. */
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
