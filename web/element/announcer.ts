/** What a player has screen readers say. */
import { html } from "../ui/dom";

/** Least time between two announcements, milliseconds. */
const ANNOUNCE_MS = 1000;

export class Announcer {
  /** The live region, seen by nobody. */
  readonly element = html("p", { class: "visually-hidden", role: "status" });
  #announcement: ReturnType<typeof setTimeout> | undefined;
  #announcedAt = 0;

  /** Has a sentence said, one a second at most; the last one counts. */
  say(sentence: string): void {
    clearTimeout(this.#announcement);
    const wait = Math.max(0, this.#announcedAt + ANNOUNCE_MS - performance.now());
    this.#announcement = setTimeout(() => {
      this.#announcedAt = performance.now();
      this.element.replaceChildren(html("span", {}, sentence));
    }, wait);
  }
}
