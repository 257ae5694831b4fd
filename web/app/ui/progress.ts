/**
 * Progress of a long task: a 2 px line at the top of its panel, with text and Cancel. Screen readers announce the begin
 * and the end; the progress itself is available from the progress bar.
 */
import type { CallOptions } from "../../client/protocol";
import { button } from "../../ui/controls/buttons";
import { html, setAttributes, setText } from "../../ui/dom";
import { strings } from "../strings/strings";
import { announce, prepareAnnouncements } from "./announce";

/** Tasks shorter than this show no progress. */
const DELAY_MS = 300;

export class ProgressLine {
  readonly element: HTMLElement;
  readonly #bar = html("div", { class: "progress-bar", role: "progressbar", "aria-valuemin": 0, "aria-valuemax": 100 });
  readonly #label = html("span");
  #controller: AbortController | undefined;

  constructor() {
    const cancel = button(strings.page.progress.cancel, () => this.cancel(), { label: true, class: "plain" });
    this.element = html("div", { class: "progress", hidden: true }, this.#bar, this.#label, cancel);
    prepareAnnouncements();
  }

  /** Whether a task is running that was not cancelled. */
  get busy(): boolean {
    return this.#controller?.signal.aborted === false;
  }

  /** Cancels the running task. */
  cancel(): void {
    this.#controller?.abort();
  }

  /** Runs a task that reports its progress here; a running one is cancelled. */
  async run<T>(label: string, task: (options: CallOptions) => Promise<T>): Promise<T> {
    this.cancel();
    const controller = new AbortController();
    this.#controller = controller;
    const present = () => this.#controller === controller;
    this.#show(label, 0);
    const appear = setTimeout(() => {
      if (!present()) return;
      this.element.hidden = false;
      announce(label);
    }, DELAY_MS);
    let over = strings.page.progress.stopped;
    try {
      const result = await task({
        signal: controller.signal,
        onProgress: (progress) => {
          if (present()) this.#show(progress.label || label, progress.fraction);
        },
      });
      over = strings.page.progress.done;
      return result;
    } finally {
      clearTimeout(appear);
      if (present()) {
        this.#controller = undefined;
        if (!this.element.hidden) announce(over);
        this.element.hidden = true;
      }
    }
  }

  #show(label: string, fraction: number): void {
    const share = Math.min(1, Math.max(0, fraction));
    setText(this.#label, label);
    setAttributes(this.#bar, { "aria-label": label, "aria-valuenow": Math.round(100 * share) });
    this.#bar.style.transform = `scaleX(${share})`;
  }
}
