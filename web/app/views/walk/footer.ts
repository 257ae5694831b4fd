/** The footer of the view: transport, clock, and actions on blocks and on the whole walk. */

import { button } from "../../../ui/controls/buttons";
import { clock, formatNumber, html, setText } from "../../../ui/dom";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { MAX_BLOCKS } from "../../state/walk";
import { strings } from "../../strings/strings";
import { Transport, type TransportListeners } from "../synthesis/transport";

const words = strings.walk;

interface FooterListeners extends TransportListeners {
  onAdd: () => void;
  onRemove: () => void;
  onBvh: () => void;
  onGlb: () => void;
  onVideo: () => void;
  /** Called to open the walk in Play as the input. */
  onStyle: () => void;
}

export class Footer {
  readonly element: HTMLElement;
  readonly #transport: Transport;
  readonly #clock = html("span", { class: "clock" });
  readonly #length = html("span", { class: "caption" });
  readonly #add: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;
  readonly #others: readonly HTMLButtonElement[];

  constructor(store: Store, listeners: FooterListeners) {
    this.#transport = new Transport(store, words, listeners);
    this.#add = button(words.add, listeners.onAdd, { icon: "add", label: true });
    this.#remove = button(words.remove, listeners.onRemove, { icon: "remove" });
    const outlined = { icon: "export", label: true, class: "outlined" } as const;
    const bvh = button(strings.synthesis.exportBvh, listeners.onBvh, outlined);
    const glb = button(strings.synthesis.exportGlb, listeners.onGlb, outlined);
    const video = button(words.video, listeners.onVideo, outlined);
    const style = button(words.styleThis, listeners.onStyle, { ...outlined, icon: "share" });
    style.title = words.styleThisWhy;
    this.#others = [...this.#transport.buttons, this.#transport.loop, bvh, glb, video, style];
    this.element = html(
      "footer",
      { class: "editor-foot" },
      this.#transport.element,
      html("p", { class: "editor-time" }, this.#clock, this.#length),
      html("div", { class: "editor-actions" }, this.#add, this.#remove, bvh, glb, video, style),
    );
  }

  /** @param ready whether there is a walk to play and save */
  show(state: Readonly<AppState>, ready: boolean): void {
    this.#transport.show(state);
    for (const element of this.#others) element.disabled = !ready;
    this.#add.disabled = !ready || state.walk.length >= MAX_BLOCKS;
    this.#remove.disabled = !ready || state.walk.length <= 1;
  }

  /** Time from the beginning of the plan, seconds. */
  set secs(secs: number) {
    setText(this.#clock, clock(secs));
  }

  /** Length of the plan, seconds. */
  set length(secs: number) {
    setText(this.#length, words.of(formatNumber(secs, 2)));
  }
}
