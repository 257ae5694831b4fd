/** Play, pause, frame steps, loop, speed and the clock; on a narrow screen also a short timeline. */

import "./transport.css";
import type { InputInfo } from "../../../client/protocol";
import { button } from "../../../ui/controls/buttons";
import { PlayButton } from "../../../ui/controls/play_button";
import { html, svg } from "../../../ui/dom";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { Scrubber, SpeedChoice } from "../../ui/transport";

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
  readonly #speed: SpeedChoice;
  readonly #scrubber: Scrubber;
  /** Contacts of the left and the right foot, left above right: the timeline of a narrow screen. */
  readonly #contacts = svg("svg", { class: "scrub-contacts", preserveAspectRatio: "none", "aria-hidden": "true" });

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
    this.#speed = new SpeedChoice((speed) => store.edit({ speed }));
    this.#scrubber = new Scrubber("clock", listeners.onScrub);
    this.#scrubber.element.addEventListener("change", () => listeners.onScrubEnd());
    const { element: scrub, clock, duration } = this.#scrubber;
    this.element = html(
      "div",
      { class: "transport-controls" },
      this.#play.element,
      html("div", { class: "transport-buttons" }, previous, next, this.#loop, key, this.#speed.element),
      html("div", { class: "scrub" }, scrub, this.#contacts),
      html("p", { class: "time" }, clock, duration),
    );
  }

  set input(input: InputInfo) {
    this.#scrubber.input = input;
    this.contacts = [[], []];
  }

  /** Ranges of frames in which the left and the right foot are planted. */
  set contacts(planted: [Stretches, Stretches]) {
    this.#contacts.setAttribute("viewBox", `0 0 ${Math.max(1, this.#scrubber.lastFrame)} 9`);
    this.#contacts.replaceChildren(
      ...planted.flatMap((stretches, foot) =>
        stretches.map(([from, to]) => svg("rect", { x: from, y: 6 * foot, width: to - from, height: 3 })),
      ),
    );
  }

  /** Moves the clock to an input frame. */
  set frame(frame: number) {
    this.#scrubber.frame = frame;
  }

  show(state: Readonly<AppState>): void {
    this.#play.playing = state.playing;
    this.#loop.setAttribute("aria-pressed", String(state.loop));
    this.#speed.value = state.speed;
  }
}
