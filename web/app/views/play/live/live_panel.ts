/** How a performer's stream goes, in numbers. */
import type { LiveStats } from "../../../../client/live/protocol";
import type { SocketState } from "../../../../streams/web_socket_poses";
import { button } from "../../../../ui/controls/buttons";
import { formatNumber, html, setText } from "../../../../ui/dom";
import { liveWords } from "./strings.en";

const words = liveWords.panel;

/** What stands for a number that is not known yet. */
const UNKNOWN = "–";

export class LivePanel {
  readonly element: HTMLElement;
  /** Below the picture. */
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

  /** @param sender who performs */
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

  /** Shows how the connection stands; `waitSecs` is how long it is waited for, and silent a sender that is there. */
  showState({ kind }: SocketState, waitSecs: number, isSilent: boolean): void {
    const said = {
      connecting: words.connecting,
      open: isSilent ? words.silent : words.open,
      waiting: words.waiting(formatNumber(waitSecs, 0)),
    };
    setText(this.#state, said[kind]);
  }

  /** A sentence about what does not work; empty where all does. */
  set fault(sentence: string) {
    setText(this.#fault, sentence);
  }

  /** @param unread messages that could not be read */
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
