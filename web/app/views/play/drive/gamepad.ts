/** Driving with a gamepad of the standard mapping. */
import { stickWish, type Wish } from "./wish";

/** Index of the button in the standard mapping, by action. */
const BUTTONS = {
  jump: 0,
  kick: 1,
  punch: 2,
  previousCorner: 4,
  nextCorner: 5,
  keep: 8,
  pause: 9,
  pointUp: 12,
  pointDown: 13,
  pointLeft: 14,
  pointRight: 15,
} as const;
const RUN_TRIGGER = 7;

/** Action of a button. */
export type PadAction = keyof typeof BUTTONS;

/** Labels of a pad's buttons: the vendor's, or numbers. */
export type Glyphs = "shapes" | "letters" | "numbers";

/** The part of a gamepad that is read. */
export type Pad = Pick<Gamepad, "id" | "connected" | "mapping"> & {
  readonly axes: readonly number[];
  readonly buttons: readonly Pick<GamepadButton, "pressed" | "value">[];
};

export class GamepadInput {
  readonly #pads: () => readonly (Pad | null)[];
  readonly #onAction: (action: PadAction) => void;
  readonly #onUse: (glyphs: Glyphs) => void;
  #pressed: readonly boolean[] = [];

  /**
   * @param onUse called while a stick or button of the pad is used
   * @param pads returns the connected pads
   */
  constructor(
    onAction: (action: PadAction) => void,
    onUse: (glyphs: Glyphs) => void,
    pads: () => readonly (Pad | null)[] = () => navigator.getGamepads?.() ?? [],
  ) {
    this.#onAction = onAction;
    this.#onUse = onUse;
    this.#pads = pads;
  }

  /** Reads the pad: runs the actions of its buttons, and returns the input of its stick; `undefined` without a pad. */
  read(): Wish | undefined {
    const pad = this.#pads().find((one) => one?.connected && one.mapping === "standard");
    if (!pad) {
      this.#pressed = [];
      return undefined;
    }
    const pressed = pad.buttons.map((button) => button.pressed);
    for (const [action, button] of Object.entries(BUTTONS))
      if (pressed[button] && !this.#pressed[button]) this.#onAction(action as PadAction);
    this.#pressed = pressed;
    // The second axis points towards the player.
    const wish = stickWish(pad.axes[0] ?? 0, -(pad.axes[1] ?? 0), 1 + (pad.buttons[RUN_TRIGGER]?.value ?? 0));
    if (wish || pressed.includes(true)) this.#onUse(glyphsOf(pad.id));
    return wish;
  }
}

/** The labels of a pad, by its name in the browser. */
export function glyphsOf(id: string): Glyphs {
  if (/054c|dualshock|dualsense/i.test(id)) return "shapes";
  return /045e|xbox|xinput/i.test(id) ? "letters" : "numbers";
}
