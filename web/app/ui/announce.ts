/** Announcements by screen readers that do not move the focus. */
import { html } from "../../ui/dom";

let region: HTMLElement | undefined;

/** Adds the page's single live region: it must exist before something is announced. */
export function prepareAnnouncements(): void {
  if (region?.isConnected) return;
  region = html("div", { class: "visually-hidden", role: "status" });
  document.body.append(region);
}

/** Announces a sentence after the current announcement. */
export function announce(sentence: string): void {
  prepareAnnouncements();
  // The same sentence again counts as a change, too.
  region!.replaceChildren(html("span", {}, sentence));
}
