/** Play, pause, frame steps, loop, speed and the clock; on a narrow screen also a short timeline. */

import "./transport.css";
import type { FrameRange, InputInfo } from "../../../client/protocol";
import { button } from "../../../ui/controls/buttons";
import { PlayButton } from "../../../ui/controls/play_button";
import { formatNumber, html, setText, svg } from "../../../ui/dom";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { Scrubber, SpeedChoice } from "../../ui/transport";
import { trimOf, trimSecs } from "./timeline/trim";
import { TrimHandles, type TrimListeners } from "./timeline/trim_handles";

/** Half the width of the scrubber's thumb. */
const THUMB_RADIUS_REM = 0.4375;

type Stretches = readonly (readonly [from: number, to: number])[];

export interface TransportListeners extends TrimListeners {
  onPlay: () => void;
  /** Called to step one frame back (−1) or forward (+1). */
  onFrame: (by: number) => void;
  /** Called to set a key of the style track at the playhead. */
  onKey: () => void;
}

export class Transport {
  readonly element: HTMLElement;
  readonly #play: PlayButton;
  readonly #loop: HTMLButtonElement;
  readonly #speed: SpeedChoice;
  readonly #scrubber: Scrubber;
  readonly #handles: TrimHandles;
  readonly #scrub = html("div", { class: "scrub" });
  /** Length of the trim; empty while the whole input is played. */
  readonly #kept = html("span", { class: "caption" });
  #input: InputInfo | undefined;
  #range: FrameRange | undefined;
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
    this.#handles = new TrimHandles(listeners, this);
    this.#scrub.append(scrub, this.#contacts, this.#handles.element);
    this.element = html(
      "div",
      { class: "transport-controls" },
      this.#play.element,
      html("div", { class: "transport-buttons" }, previous, next, this.#loop, key, this.#speed.element),
      this.#scrub,
      html("p", { class: "time" }, clock, duration, this.#kept),
    );
  }

  set input(input: InputInfo) {
    this.#input = input;
    this.#scrubber.input = input;
    this.#handles.input = input;
    this.contacts = [[], []];
    this.#showTrim();
  }

  /** Position of a frame on the scrubber, whose thumb stays within its ends; a length of CSS. */
  left(frame: number): string {
    const share = frame / Math.max(1, this.#scrubber.lastFrame);
    return `calc(${THUMB_RADIUS_REM}rem + ${share.toFixed(4)} * (100% - ${2 * THUMB_RADIUS_REM}rem))`;
  }

  /** Frame of the scrubber at an X position in the page. */
  frameAt(clientX: number): number {
    const box = this.#scrub.getBoundingClientRect();
    const inset = THUMB_RADIUS_REM * Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
    const share = (clientX - box.left - inset) / Math.max(1, box.width - 2 * inset);
    return Math.min(1, Math.max(0, share)) * this.#scrubber.lastFrame;
  }

  #showTrim(): void {
    const [input, range] = [this.#input, this.#range];
    this.#handles.range = range;
    setText(this.#kept, input && range ? strings.play.trim.kept(formatNumber(trimSecs(range, input), 2)) : "");
    const { first, last } = trimOf(range, input?.frames ?? 2);
    this.#scrub.style.setProperty("--trim-first", this.left(first));
    this.#scrub.style.setProperty("--trim-last", this.left(last));
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
    if (this.#range === state.range) return;
    this.#range = state.range;
    this.#showTrim();
  }
}
