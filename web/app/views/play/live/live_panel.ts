/** State of a performer's stream in numbers. */
import type { LiveStats } from "../../../../client/live/protocol";
import type { SocketState } from "../../../../streams/web_socket_poses";
import { button } from "../../../../ui/controls/buttons";
import { formatNumber, html, setText } from "../../../../ui/dom";
import { liveWords } from "./strings.en";

const words = liveWords.panel;

/** Placeholder of a number that is not known yet. */
const UNKNOWN = "–";

export class LivePanel {
  readonly element: HTMLElement;
  /** The figures below the picture. */
  readonly figures: HTMLElement;
  readonly #state = html("b");
  readonly #rate = html("b");
  readonly #late = html("b");
  readonly #lost = html("b");
  readonly #buffer = html("b");
  readonly #latency = html("b");
  readonly #unread = html("b");
  readonly #unreadRow: HTMLElement;
  readonly #fault = html("p", { class: "caption live-fault", role: "status" });

  /** @param sender display name of the sender */
  constructor(sender: string, onChange: () => void) {
    const row = (name: string, value: HTMLElement, unit: string) =>
      html("div", { class: "live-row" }, html("dt", {}, name), html("dd", {}, value, unit && ` ${unit}`));
    this.#unreadRow = row(words.unread, this.#unread, words.messages);
    this.figures = html(
      "dl",
      { class: "live-figures", "aria-label": words.figures },
      row(words.rate, this.#rate, words.hertz),
      row(words.late, this.#late, words.percent),
      row(words.lost, this.#lost, words.percent),
      row(words.buffer, this.#buffer, words.milliseconds),
      row(words.shownAfter, this.#latency, words.milliseconds),
      this.#unreadRow,
    );
    this.element = html(
      "section",
      { class: "section live-panel", "aria-labelledby": "live-heading" },
      html(
        "div",
        { class: "section-heading" },
        html("h2", { id: "live-heading" }, words.heading),
        html("span", { class: "caption" }, sender),
      ),
      html("dl", {}, row(words.state, this.#state, "")),
      this.#fault,
      button(words.change, onChange, { label: true, class: "outlined" }),
    );
  }

  /**
   * Shows the state of the connection; `waitSecs` is the time until the next attempt, and `isSilent` means that a
   * connected sender sends nothing.
   */
  showState({ kind }: SocketState, waitSecs: number, isSilent: boolean): void {
    const said = {
      connecting: words.connecting,
      open: isSilent ? words.silent : words.open,
      waiting: words.waiting(formatNumber(waitSecs, 0)),
    };
    setText(this.#state, said[kind]);
  }

  /** A sentence about the current problem; empty if there is none. */
  set fault(sentence: string) {
    setText(this.#fault, sentence);
  }

  /** @param unread number of messages that could not be read */
  show({ taken, periodSecs, late, missing, delaySecs, latencySecs, refused, frames }: LiveStats, unread: number): void {
    const number = (isKnown: boolean, value: number, digits: number) =>
      isKnown ? formatNumber(value, digits) : UNKNOWN;
    const comes = taken > 1;
    setText(this.#rate, number(comes, 1 / periodSecs, 0));
    setText(this.#late, number(comes, (100 * late) / taken, 1));
    setText(this.#lost, number(comes, (100 * missing) / (taken + missing), 1));
    setText(this.#buffer, number(comes, 1000 * delaySecs, 0));
    setText(this.#latency, number(frames > 0, 1000 * latencySecs[0], 0));
    setText(this.#unread, String(unread + refused));
    this.#unreadRow.hidden = unread + refused === 0;
  }
}
