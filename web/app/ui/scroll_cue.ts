/** A cue at the lower edge of a part that scrolls, while there is more below. */
import "./scroll_cue.css";
import { icon } from "../../ui/controls/icons";
import { html } from "../../ui/dom";

/** Shows the cue in `scroller` until the signal aborts. It is appended to the contents, which must not be replaced. */
export function showScrollCue(scroller: HTMLElement, signal: AbortSignal): void {
  const cue = html(
    "div",
    { class: "scroll-cue", "aria-hidden": "true", hidden: true },
    html("div", {}, icon("chevron")),
  );
  const end = html("div", { class: "scroll-end", "aria-hidden": "true" });
  scroller.append(cue, end);
  const observer = new IntersectionObserver(
    ([entry]) => {
      cue.hidden = entry?.isIntersecting ?? true;
    },
    { root: scroller },
  );
  observer.observe(end);
  signal.addEventListener("abort", () => observer.disconnect(), { once: true });
}
