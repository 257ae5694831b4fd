/** The buttons that play, step through and loop a motion. */
import { button } from "../../../ui/controls/buttons";
import { PlayButton } from "../../../ui/controls/play_button";
import { html } from "../../../ui/dom";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";

export interface TransportListeners {
  onPlay: () => void;
  onPrevious: () => void;
  onNext: () => void;
}

/** Names of the buttons whose meaning depends on the view. */
interface TransportNames {
  previous: string;
  next: string;
  loop: string;
}

export class Transport {
  readonly element: HTMLElement;
  /** The loop button; the others play and step. */
  readonly loop: HTMLButtonElement;
  readonly buttons: readonly HTMLButtonElement[];
  readonly #play: PlayButton;

  constructor(store: Store, names: TransportNames, listeners: TransportListeners) {
    this.#play = new PlayButton(listeners.onPlay);
    const previous = button(names.previous, listeners.onPrevious, { icon: "previous", keys: "←" });
    const next = button(names.next, listeners.onNext, { icon: "next", keys: "→" });
    this.loop = button(names.loop, () => store.edit({ loop: !store.state.loop }), { icon: "loop", keys: "L" });
    this.buttons = [this.#play.element, previous, next];
    this.element = html("div", { class: "editor-transport" }, ...this.buttons, this.loop);
  }

  show({ playing, loop }: Readonly<AppState>): void {
    this.#play.playing = playing;
    this.loop.setAttribute("aria-pressed", String(loop));
  }
}
