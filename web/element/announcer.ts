/** Screen reader announcements of a player. */
import { html } from "../ui/dom";

/** Minimum time between two announcements, milliseconds. */
const ANNOUNCE_MS = 1000;

export class Announcer {
  /** The visually hidden live region. */
  readonly element = html("p", { class: "visually-hidden", role: "status" });
  #announcement: ReturnType<typeof setTimeout> | undefined;
  #announcedAt = 0;

  /** Announces a sentence, at most one per second; the last one counts. */
  say(sentence: string): void {
    clearTimeout(this.#announcement);
    const wait = Math.max(0, this.#announcedAt + ANNOUNCE_MS - performance.now());
    this.#announcement = setTimeout(() => {
      this.#announcedAt = performance.now();
      this.element.replaceChildren(html("span", {}, sentence));
    }, wait);
  }
}
