/** Play, pause, frame steps, loop, speed and the clock; on a narrow screen also a short timeline. */

import "./transport.css";
import type { InputInfo } from "../../../client/protocol";
import { SPEEDS } from "../../../link/page";
import { button } from "../../../ui/controls/buttons";
import { PlayButton } from "../../../ui/controls/play_button";
import { rangeInput } from "../../../ui/controls/range_input";
import { clock, html, setText, svg } from "../../../ui/dom";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";

type Stretches = readonly (readonly [from: number, to: number])[];

export interface TransportListeners {
  onPlay: () => void;
  /** Called to step one frame back (−1) or forward (+1). */
  onFrame: (by: number) => void;
  /** Called to set a key of the style track at the playhead. */
  onKey: () => void;
  onScrub: (frame: number) => void;
  onScrubEnd: () => void;
}

export class Transport {
  readonly element: HTMLElement;
  readonly #play: PlayButton;
  readonly #loop: HTMLButtonElement;
  readonly #speed: HTMLSelectElement;
  readonly #clock = html("span", { class: "clock" });
  readonly #duration = html("span", { class: "caption" });
  readonly #scrub: HTMLInputElement;
  /** Contacts of the left and the right foot, left above right: the timeline of a narrow screen. */
  readonly #contacts = svg("svg", { class: "scrub-contacts", preserveAspectRatio: "none", "aria-hidden": "true" });
  #rateHz = 60;

  constructor(store: Store, listeners: TransportListeners) {
    this.#play = new PlayButton(listeners.onPlay);
    const previous = button(strings.play.transport.previous, () => listeners.onFrame(-1), {
      icon: "previous",
      keys: "←",
    });
    const next = button(strings.play.transport.next, () => listeners.onFrame(1), { icon: "next", keys: "→" });
    this.#loop = button(strings.play.transport.loop, () => store.edit({ loop: !store.state.loop }), {
      icon: "loop",
      keys: "L",
    });
    const key = button(strings.play.transport.key, listeners.onKey, { icon: "key", keys: "K" });
    this.#speed = html("select", {
      class: "speed",
      "aria-label": strings.play.transport.speed,
      title: strings.play.transport.speed,
    });
    for (const speed of SPEEDS) this.#speed.append(html("option", { value: speed }, `${speed}×`));
    this.#speed.addEventListener("change", () => store.edit({ speed: Number(this.#speed.value) }));
    this.#scrub = rangeInput({ min: 0, step: 1, "aria-label": strings.play.transport.time });
    this.#scrub.addEventListener("input", () => listeners.onScrub(Number(this.#scrub.value)));
    this.#scrub.addEventListener("change", () => listeners.onScrubEnd());
    this.element = html(
      "div",
      { class: "transport-controls" },
      this.#play.element,
      html("div", { class: "transport-buttons" }, previous, next, this.#loop, key, this.#speed),
      html("div", { class: "scrub" }, this.#scrub, this.#contacts),
      html("p", { class: "time" }, this.#clock, this.#duration),
    );
  }

  set input(input: InputInfo) {
    this.#rateHz = input.rateHz;
    this.#scrub.max = String(Math.max(0, input.frames - 1));
    this.contacts = [[], []];
    setText(this.#duration, strings.play.transport.of(clock(input.durationSecs)));
  }

  /** Ranges of frames in which the left and the right foot are planted. */
  set contacts(planted: [Stretches, Stretches]) {
    this.#contacts.setAttribute("viewBox", `0 0 ${Math.max(1, Number(this.#scrub.max))} 9`);
    this.#contacts.replaceChildren(
      ...planted.flatMap((stretches, foot) =>
        stretches.map(([from, to]) => svg("rect", { x: from, y: 6 * foot, width: to - from, height: 3 })),
      ),
    );
  }

  /** Moves the clock to an input frame. */
  set frame(frame: number) {
    setText(this.#clock, clock(frame / this.#rateHz));
    this.#scrub.value = String(Math.round(frame));
    this.#scrub.style.setProperty("--share", String(frame / Math.max(1, Number(this.#scrub.max))));
  }

  show(state: Readonly<AppState>): void {
    this.#play.playing = state.playing;
    this.#loop.setAttribute("aria-pressed", String(state.loop));
    this.#speed.value = String(state.speed);
  }
}
