/** What screen readers say without the focus going anywhere. */
import { html } from "../../ui/dom";

let region: HTMLElement | undefined;

/** Puts the page's one live region in place: it must be there before something is announced. */
export function prepareAnnouncements(): void {
  if (region?.isConnected) return;
  region = html("div", { class: "visually-hidden", role: "status" });
  document.body.append(region);
}

/** Has a sentence said once what is being said has ended. */
export function announce(sentence: string): void {
  prepareAnnouncements();
  // The same sentence again is a change too.
  region!.replaceChildren(html("span", {}, sentence));
}
