/** The transport of the Compare view: one clock for all columns. */
import type { InputInfo } from "../../../client/protocol";
import { button } from "../../../ui/controls/buttons";
import { PlayButton } from "../../../ui/controls/play_button";
import { html } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { Scrubber, SpeedChoice } from "../../ui/transport";

interface CompareTransportListeners {
  onPlay: () => void;
  onFrame: (by: number) => void;
  onScrub: (frame: number) => void;
  onSpeed: (speed: number) => void;
}

export class CompareTransport {
  readonly element: HTMLElement;
  readonly #play: PlayButton;
  readonly #speed: SpeedChoice;
  readonly #scrubber: Scrubber;

  constructor(listeners: CompareTransportListeners) {
    this.#play = new PlayButton(listeners.onPlay);
    const { previous, next } = strings.play.transport;
    this.#speed = new SpeedChoice(listeners.onSpeed);
    this.#scrubber = new Scrubber("compare-clock", listeners.onScrub, strings.compare.seconds);
    const { clock, duration } = this.#scrubber;
    this.element = html(
      "div",
      { class: "compare-transport" },
      this.#play.element,
      button(previous, () => listeners.onFrame(-1), { icon: "previous", keys: "←" }),
      button(next, () => listeners.onFrame(1), { icon: "next", keys: "→" }),
      this.#speed.element,
      html("div", { class: "slider-track" }, this.#scrubber.element),
      html("p", { class: "compare-time" }, clock, duration),
    );
  }

  set input(input: InputInfo) {
    this.#scrubber.input = input;
  }

  set frame(frame: number) {
    this.#scrubber.frame = frame;
  }

  show({ playing, speed }: { playing: boolean; speed: number }): void {
    this.#play.playing = playing;
    this.#speed.value = speed;
  }
}
