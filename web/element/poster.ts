/** Shown in the stage until the figure can be drawn: a picture, a play symbol, and the progress of loading. */
import { icon } from "../ui/controls/icons";
import { html } from "../ui/dom";
import { strings } from "./strings";

export class Poster {
  readonly element: HTMLElement;
  readonly #button: HTMLButtonElement;
  readonly #line = html("div", { class: "loading-line" });
  readonly #image = html("img", { alt: "", decoding: "async", hidden: true });

  constructor(onPress: () => void) {
    const sign = html("span", { class: "poster-sign" }, icon("play", 24));
    const slot = html("slot", { name: "poster" }, this.#image);
    this.#button = html(
      "button",
      { type: "button", class: "poster", part: "poster", "aria-label": strings.play },
      slot,
      sign,
    );
    this.#button.addEventListener("click", onPress);
    this.element = html("div", { class: "poster-box" }, this.#button, this.#line);
  }

  /** URL of the picture; empty for none. */
  set picture(url: string) {
    this.#image.hidden = url === "";
    if (url === "") this.#image.removeAttribute("src");
    else this.#image.src = url;
  }

  /** Progress of loading, 0 to 1; `undefined` while nothing is being loaded. */
  set fraction(fraction: number | undefined) {
    this.element.classList.toggle("loading", fraction !== undefined);
    this.#line.hidden = fraction === undefined;
    this.#line.style.setProperty("--fraction", String(fraction ?? 0));
  }

  set hidden(hidden: boolean) {
    this.element.hidden = hidden;
  }
}
