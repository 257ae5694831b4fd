/** Parts of the transports of several views: the choice of the speed, and the scrubber with its clock. */
import type { InputInfo } from "../../client/protocol";
import { SPEEDS } from "../../link/page";
import { rangeInput } from "../../ui/controls/range_input";
import { clock, html, setText } from "../../ui/dom";
import { strings } from "../strings/strings";

const words = strings.play.transport;

export class SpeedChoice {
  readonly element = html("select", { class: "speed", "aria-label": words.speed, title: words.speed });

  constructor(onSpeed: (speed: number) => void) {
    this.element.append(...SPEEDS.map((speed) => html("option", { value: speed }, `${speed}×`)));
    this.element.addEventListener("change", () => onSpeed(Number(this.element.value)));
  }

  set value(speed: number) {
    this.element.value = String(speed);
  }
}

/** A slider over the frames of an input. */
export class Scrubber {
  readonly element = rangeInput({ min: 0, step: 1, "aria-label": words.time });
  readonly clock: HTMLElement;
  readonly duration = html("span", { class: "caption" });
  readonly #say: ((time: string) => string) | undefined;
  #rateHz = 60;

  /** @param say announces a time; by default the frame is announced */
  constructor(clockClass: string, onScrub: (frame: number) => void, say?: (time: string) => string) {
    this.clock = html("span", { class: clockClass });
    this.#say = say;
    this.element.addEventListener("input", () => onScrub(Number(this.element.value)));
  }

  get lastFrame(): number {
    return Number(this.element.max);
  }

  set input({ rateHz, frames, durationSecs }: InputInfo) {
    this.#rateHz = rateHz;
    this.element.max = String(Math.max(0, frames - 1));
    setText(this.duration, words.of(clock(durationSecs)));
  }

  set frame(frame: number) {
    const time = clock(frame / this.#rateHz);
    setText(this.clock, time);
    this.element.value = String(Math.round(frame));
    this.element.style.setProperty("--share", String(frame / Math.max(1, this.lastFrame)));
    if (this.#say) this.element.setAttribute("aria-valuetext", this.#say(time));
  }
}
