/** The transport of the Compare view: one clock for all columns. */
import type { InputInfo } from "../../../client/protocol";
import { button } from "../../../ui/controls/buttons";
import { PlayButton } from "../../../ui/controls/play_button";
import { rangeInput } from "../../../ui/controls/range_input";
import { clock, html, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";

export interface CompareTransportListeners {
  onPlay: () => void;
  onFrame: (by: number) => void;
  onScrub: (frame: number) => void;
  onSpeed: (speed: number) => void;
  speeds: readonly number[];
}

export class CompareTransport {
  readonly element: HTMLElement;
  readonly #play: PlayButton;
  readonly #speed = html("select", {
    class: "speed",
    "aria-label": strings.play.transport.speed,
    title: strings.play.transport.speed,
  });
  readonly #scrub = rangeInput({ min: 0, step: 1, "aria-label": strings.play.transport.time });
  readonly #clock = html("span", { class: "compare-clock" });
  readonly #duration = html("span", { class: "caption" });
  #rateHz = 60;

  constructor(listeners: CompareTransportListeners) {
    this.#play = new PlayButton(listeners.onPlay);
    const previous = button(strings.play.transport.previous, () => listeners.onFrame(-1), {
      icon: "previous",
      keys: "←",
    });
    const next = button(strings.play.transport.next, () => listeners.onFrame(1), { icon: "next", keys: "→" });
    for (const speed of listeners.speeds) this.#speed.append(html("option", { value: speed }, `${speed}×`));
    this.#speed.addEventListener("change", () => listeners.onSpeed(Number(this.#speed.value)));
    this.#scrub.addEventListener("input", () => listeners.onScrub(Number(this.#scrub.value)));
    this.element = html(
      "div",
      { class: "compare-transport" },
      this.#play.element,
      previous,
      next,
      this.#speed,
      html("div", { class: "slider-track" }, this.#scrub),
      html("p", { class: "compare-time" }, this.#clock, this.#duration),
    );
  }

  set input(input: InputInfo) {
    this.#rateHz = input.rateHz;
    this.#scrub.max = String(Math.max(0, input.frames - 1));
    setText(this.#duration, strings.play.transport.of(clock(input.durationSecs)));
  }

  set frame(frame: number) {
    setText(this.#clock, clock(frame / this.#rateHz));
    this.#scrub.value = String(Math.round(frame));
    this.#scrub.style.setProperty("--share", String(frame / Math.max(1, Number(this.#scrub.max))));
    this.#scrub.setAttribute("aria-valuetext", strings.compare.seconds(clock(frame / this.#rateHz)));
  }

  show({ playing, speed }: { playing: boolean; speed: number }): void {
    this.#play.playing = playing;
    this.#speed.value = String(speed);
  }
}
