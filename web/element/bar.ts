/** The bar under the stage: play, time, ghost, full screen, and the link to Strut. */

import { button } from "../ui/controls/buttons";
import { mark } from "../ui/controls/icons";
import { PlayButton } from "../ui/controls/play_button";
import { rangeInput } from "../ui/controls/range_input";
import { clock, formatNumber, html, setText } from "../ui/dom";
import type { Control, ValueOf } from "./attributes";
import { strings } from "./strings";

interface BarListeners {
  onPlay: () => void;
  /** Called when a time was selected, as an input frame. */
  onSeek: (frame: number) => void;
  onGhost: () => void;
  onFullscreen: () => void;
}

export class Bar {
  readonly element: HTMLElement;
  readonly #play: PlayButton;
  readonly #seek: HTMLInputElement;
  readonly #clock = html("span", { class: "clock", part: "clock", "aria-hidden": "true" });
  readonly #ghost: HTMLButtonElement;
  readonly #fullscreen: HTMLButtonElement;
  readonly #divider = html("span", { class: "bar-divider" });
  readonly #link: HTMLAnchorElement;
  #rateHz = 60;
  #frames = 1;

  /** @param site URL of the playground; empty if it is not known */
  constructor(listeners: BarListeners, site: string) {
    this.#play = new PlayButton(listeners.onPlay);
    this.#play.element.part.add("play");
    this.#seek = rangeInput({ class: "seek", part: "seek", min: 0, max: 1, step: 1, value: 0 });
    this.#seek.setAttribute("aria-label", strings.seek);
    this.#seek.addEventListener("input", () => listeners.onSeek(Number(this.#seek.value)));
    this.#ghost = button(strings.ghost.name, listeners.onGhost, { icon: "ghost", keys: "G" });
    this.#ghost.part.add("ghost");
    this.#fullscreen = button(strings.fullscreen, listeners.onFullscreen, { icon: "fullscreen", keys: "F" });
    this.#fullscreen.part.add("fullscreen");
    this.#link = html("a", { class: "link", part: "link", target: "_blank", rel: "noopener", title: strings.link });
    this.#link.append(mark(16), html("span", {}, strings.brand));
    if (site) this.#link.href = site;
    this.element = html(
      "div",
      { class: "bar", part: "bar" },
      this.#play.element,
      this.#seek,
      this.#clock,
      this.#divider,
      this.#ghost,
      this.#fullscreen,
      this.#link,
      html("slot", { name: "controls" }),
    );
    this.frame = 0;
  }

  /** The controls to show. */
  set controls(controls: readonly Control[]) {
    const show = (element: Element, on: boolean) => element.toggleAttribute("hidden", !on);
    show(this.#play.element, controls.includes("play"));
    show(this.#seek, controls.includes("seek"));
    show(this.#clock, controls.includes("seek"));
    show(this.#ghost, controls.includes("ghost"));
    show(this.#fullscreen, controls.includes("fullscreen") && document.fullscreenEnabled);
    show(this.#link, controls.includes("link"));
    show(
      this.#divider,
      (["ghost", "fullscreen", "link"] as const).some((control) => controls.includes(control)),
    );
    show(
      this.element,
      controls.some((control) => control !== "styles"),
    );
  }

  set playing(playing: boolean) {
    this.#play.playing = playing;
  }

  set ghost(ghost: ValueOf<"ghost">) {
    this.#ghost.setAttribute("aria-pressed", String(ghost !== "off"));
    this.#ghost.title = `${strings.ghost[ghost]} (G)`;
  }

  /** URL of the displayed state in the playground. */
  set href(href: string) {
    this.#link.href = href;
  }

  /** Length of the motion. */
  setDuration(frames: number, rateHz: number): void {
    [this.#frames, this.#rateHz] = [frames, rateHz];
    this.#seek.max = String(Math.max(1, frames - 1));
  }

  /** The displayed input frame. */
  set frame(frame: number) {
    const [now, duration] = [frame / this.#rateHz, (this.#frames - 1) / this.#rateHz];
    setText(this.#clock, clock(now));
    this.#seek.value = String(Math.round(frame));
    this.#seek.style.setProperty("--share", String(frame / Math.max(1, this.#frames - 1)));
    this.#seek.setAttribute("aria-valuetext", strings.seekValue(formatNumber(now, 2), formatNumber(duration, 2)));
  }
}
