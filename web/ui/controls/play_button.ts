/** The play button. */
import { strings } from "../strings";
import { button } from "./buttons";
import { icon } from "./icons";

const KEYS = "Space";

export class PlayButton {
  readonly element: HTMLButtonElement;
  #playing = false;

  constructor(onPress: () => void) {
    this.element = button(strings.playButton.play, onPress, { icon: "play", class: "play", keys: KEYS });
  }

  /** Whether the motion plays: the button then pauses. */
  set playing(playing: boolean) {
    if (playing === this.#playing) return;
    this.#playing = playing;
    const name = strings.playButton[playing ? "pause" : "play"];
    this.element.setAttribute("aria-label", name);
    this.element.title = `${name} (${KEYS})`;
    this.element.replaceChildren(icon(playing ? "pause" : "play", 18));
  }
}
