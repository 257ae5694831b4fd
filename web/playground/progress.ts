/** Progress of something long: a 2 px line at the top of the panel it belongs to, with words and Cancel. */
import type { CallOptions } from "../worker/protocol";
import { button } from "./controls/buttons";
import { html, setText } from "./dom";

/** What is done sooner than this shows no progress. */
const DELAY_MS = 300;

export class ProgressLine {
  readonly element: HTMLElement;
  readonly #bar = html("div", { class: "progress-bar" });
  readonly #label = html("span", { role: "status" });
  #controller: AbortController | undefined;

  constructor() {
    const cancel = button("Cancel", () => this.cancel(), { label: true, class: "plain" });
    this.element = html("div", { class: "progress", hidden: true }, this.#bar, this.#label, cancel);
  }

  /** Cancels what runs. */
  cancel(): void {
    this.#controller?.abort();
  }

  /** Runs a task that reports its progress here; what ran before is cancelled. */
  async run<T>(label: string, task: (options: CallOptions) => Promise<T>): Promise<T> {
    this.cancel();
    const controller = new AbortController();
    this.#controller = controller;
    this.#show(label, 0);
    const appear = setTimeout(() => {
      if (this.#controller === controller) this.element.hidden = false;
    }, DELAY_MS);
    try {
      return await task({
        signal: controller.signal,
        onProgress: (progress) => {
          if (this.#controller === controller) this.#show(progress.label || label, progress.fraction);
        },
      });
    } finally {
      clearTimeout(appear);
      if (this.#controller === controller) {
        this.#controller = undefined;
        this.element.hidden = true;
      }
    }
  }

  #show(label: string, fraction: number): void {
    setText(this.#label, label);
    this.#bar.style.transform = `scaleX(${Math.min(1, Math.max(0, fraction))})`;
  }
}
