/** The footer of the view: transport, clock, chart of styles, and exports. */

import { SPEEDS } from "../../../link/page";
import { button } from "../../../ui/controls/buttons";
import { PlayButton } from "../../../ui/controls/play_button";
import { clock, html, setText } from "../../../ui/dom";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { SpeedChoice } from "../../ui/transport";
import type { ShareChart } from "./share_chart";

const words = strings.crowd;

interface FooterListeners {
  onPlay: () => void;
  onStep: () => void;
  onPoster: () => void;
  onVideo: () => void;
}

export class Footer {
  readonly element: HTMLElement;
  readonly #play: PlayButton;
  readonly #step: HTMLButtonElement;
  readonly #speed: SpeedChoice;
  readonly #clock = html("span", { class: "clock" });
  readonly #running = html("span", { class: "caption" });
  readonly #outputs: readonly HTMLButtonElement[];

  constructor(store: Store, chart: ShareChart, listeners: FooterListeners) {
    this.#play = new PlayButton(listeners.onPlay);
    this.#step = button(words.step, listeners.onStep, { icon: "next", keys: "→" });
    this.#speed = new SpeedChoice((speed) => store.edit({ speed }));
    const poster = button(words.poster, listeners.onPoster, { icon: "picture", label: true, class: "outlined" });
    const video = button(words.video, listeners.onVideo, { icon: "film", label: true, class: "outlined" });
    // On a narrow screen there is no room for their text.
    for (const [output, name] of [
      [poster, words.poster],
      [video, words.video],
    ] as const)
      output.setAttribute("aria-label", name);
    this.#outputs = [poster, video];
    this.element = html(
      "footer",
      { class: "crowd-foot" },
      html(
        "div",
        { class: "crowd-transport" },
        html("div", {}, this.#play.element, this.#step, this.#speed.element),
        html("p", {}, this.#clock, this.#running),
      ),
      chart.element,
      html("div", { class: "crowd-outputs" }, poster, video, html("p", { class: "caption" }, words.videoWhy)),
    );
  }

  show(playing: boolean, speed: number, ready: boolean): void {
    this.#play.playing = playing;
    this.#speed.value = SPEEDS.find((one) => one >= speed) ?? SPEEDS.at(-1)!;
    setText(this.#running, words.clockState[playing ? "running" : "paused"]);
    for (const element of [this.#play.element, this.#step, ...this.#outputs]) element.disabled = !ready;
  }

  /** Time of the crowd, seconds. */
  set secs(secs: number) {
    setText(this.#clock, clock(secs));
  }
}
