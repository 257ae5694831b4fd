/** The line that explains the controls of the device used last. */
import type { Move } from "../../../../client/drive/protocol";
import { html } from "../../../../ui/dom";
import type { Glyphs } from "./gamepad";
import { driveWords } from "./strings.en";

const words = driveWords.help;

/** Devices for steering. */
export type Device = "keyboard" | "touch" | Glyphs;

/** Keys of the moves. */
const MOVE_KEYS: Readonly<Record<Move, string>> = { jump: "Space", punch: "C", kick: "V" };

export class HelpLine {
  readonly element = html("p", { class: "drive-help", "aria-label": words.name });
  readonly #moves: readonly Move[];
  #device: Device | undefined;

  constructor(moves: readonly Move[], device: Device) {
    this.#moves = moves;
    this.device = device;
  }

  /** The device used last. */
  set device(device: Device) {
    if (device === this.#device) return;
    this.#device = device;
    this.element.replaceChildren(...this.#items(device));
  }

  get isShown(): boolean {
    return !this.element.hidden;
  }

  set isShown(shown: boolean) {
    this.element.hidden = !shown;
  }

  #items(device: Device): HTMLElement[] {
    if (device === "touch")
      return [
        item([words.stick], words.stickGo),
        item([words.path], words.pathWhy),
        item([words.arrow], words.arrowTurn),
      ];
    if (device === "keyboard")
      return [
        item(["W", "A", "S", "D"], words.go),
        item(["Shift"], words.run),
        item(["Q", "E"], words.turn),
        ...this.#moves.map((move) => item([MOVE_KEYS[move]], words.moves[move])),
        item([words.click], words.walkThere),
        item([], words.pad),
      ];
    return [
      item([words.padStick], words.go),
      item([words.padRun[device]], words.run),
      ...this.#moves.map((move) => item([words.padButtons[device][move]], words.moves[move])),
    ];
  }
}

function item(keys: readonly string[], does: string): HTMLElement {
  return html("span", { class: "drive-help-item" }, ...keys.map((key) => html("kbd", {}, key)), does);
}
