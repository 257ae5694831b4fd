/**
 * A knob: 270° arc, changed by vertical drag, arrow keys, typing, or the wheel while it has the focus; a double click
 * restores the default. For assistive technology the dial is a slider and the number under it a text field.
 */
import { formatNumber, html, setAttributes, svg } from "../dom";
import { type GestureListeners, listenToDrags } from "../drag";
import { type DialRange, parseTyped, shareOf, stepped, valueAt } from "./dial";

/** Drag distance for the whole travel, pixels. */
const TRAVEL_PX = 160;
/** Share of the travel per notch of the wheel or arrow key, and with Shift. */
const STEP = 0.04;
const FINE_STEP = 0.004;
/** Angle of the arc and its start, degrees clockwise from the top. */
const SWEEP = 270;
const START = -135;
const RADIUS = 18;

interface KnobListeners extends GestureListeners {
  onInput: (value: number) => void;
}

const polar = (degrees: number, radius: number): string => {
  const angle = (degrees * Math.PI) / 180;
  return `${(radius * Math.sin(angle)).toFixed(3)} ${(-radius * Math.cos(angle)).toFixed(3)}`;
};

/** Path of the arc from the start over a share of the sweep. */
const arc = (share: number): string => {
  const end = START + SWEEP * share;
  const large = SWEEP * share > 180 ? 1 : 0;
  return `M${polar(START, RADIUS)}A${RADIUS} ${RADIUS} 0 ${large} 1 ${polar(end, RADIUS)}`;
};

/** Number formatting: the decimal sign, and the name of a field for a number. */
interface KnobLanguage {
  decimal: string;
  number: string;
}

const ENGLISH: KnobLanguage = { decimal: ".", number: "number" };

export interface KnobText {
  symbol: string;
  name: string;
  description: string;
}

export class Knob {
  readonly element: HTMLElement;
  readonly #dial: HTMLElement;
  readonly #filled: SVGPathElement;
  readonly #pointer: SVGLineElement;
  readonly #number: HTMLInputElement;
  readonly #range: DialRange;
  readonly #listeners: KnobListeners;
  readonly #decimal: string;
  #value: number;

  /** `symbol` is displayed, `name` and `description` are announced and shown as a tooltip. */
  constructor(
    text: KnobText,
    range: DialRange,
    initial: number,
    listeners: KnobListeners,
    { decimal, number }: KnobLanguage = ENGLISH,
  ) {
    this.#decimal = decimal;
    this.#range = range;
    this.#listeners = listeners;
    this.#value = initial;
    this.#filled = svg("path", { class: "knob-filled" });
    this.#pointer = svg("line", { class: "knob-pointer", x1: 0, y1: -6, x2: 0, y2: -10 });
    this.#dial = html(
      "div",
      {
        class: "knob-dial",
        role: "slider",
        tabindex: 0,
        "aria-label": text.name,
        "aria-description": text.description,
        "aria-valuemin": range.min,
        "aria-valuemax": range.max,
      },
      svg(
        "svg",
        { viewBox: "-20 -20 40 40", "aria-hidden": "true" },
        svg("path", { class: "knob-arc", d: arc(1) }),
        this.#filled,
        svg("circle", { class: "knob-body", r: 13 }),
        this.#pointer,
      ),
    );
    this.#number = html("input", {
      class: "knob-number",
      type: "text",
      inputmode: "decimal",
      "aria-label": `${text.name}, ${number}`,
    });
    const caption = html("span", { class: "knob-symbol", "aria-hidden": "true" }, text.symbol);
    this.element = html("div", { class: "knob", title: text.description }, this.#dial, caption, this.#number);
    this.value = initial;
    this.#listenToDial(initial);
    this.#listenToNumber();
  }

  set value(value: number) {
    this.#value = value;
    const share = shareOf(value, this.#range);
    const shown = this.#shown;
    setAttributes(this.#filled, { d: arc(share) });
    setAttributes(this.#pointer, { transform: `rotate(${START + SWEEP * share})` });
    setAttributes(this.#dial, { "aria-valuenow": value, "aria-valuetext": shown });
    if (document.activeElement !== this.#number && this.#number.value !== shown) this.#number.value = shown;
  }

  get #shown(): string {
    return formatNumber(this.#value, this.#range.digits).replace(".", this.#decimal);
  }

  #turn(value: number): void {
    if (value !== this.#value) this.#listeners.onInput(value);
  }

  #listenToDial(initial: number): void {
    const dial = this.#dial;
    listenToDrags(dial, (press) => {
      const { onSettle, onCancel } = this.#listeners;
      const share = shareOf(this.#value, this.#range);
      onSettle();
      return {
        move: ({ clientY }) => this.#turn(valueAt(share + (press.clientY - clientY) / TRAVEL_PX, this.#range)),
        cancel: onCancel,
        end: onSettle,
      };
    });
    dial.addEventListener(
      "wheel",
      (event) => {
        // Scrolling the page over a knob does not change it.
        if (!dial.matches(":focus")) return;
        event.preventDefault();
        this.#turn(stepped(this.#value, -Math.sign(event.deltaY) * STEP, this.#range));
      },
      { passive: false },
    );
    dial.addEventListener("dblclick", () => {
      this.#turn(initial);
      this.#listeners.onSettle();
    });
    dial.addEventListener("keydown", (event) => this.#onKey(event));
    dial.addEventListener("blur", () => this.#listeners.onSettle());
  }

  #onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? FINE_STEP : STEP;
    const range = this.#range;
    const next = {
      ArrowUp: () => stepped(this.#value, step, range),
      ArrowRight: () => stepped(this.#value, step, range),
      ArrowDown: () => stepped(this.#value, -step, range),
      ArrowLeft: () => stepped(this.#value, -step, range),
      PageUp: () => stepped(this.#value, 0.2, range),
      PageDown: () => stepped(this.#value, -0.2, range),
      Home: () => range.min,
      End: () => range.max,
    }[event.key];
    if (next) {
      event.preventDefault();
      event.stopPropagation();
      this.#turn(next());
    } else if (/^[\d.,]$/.test(event.key)) {
      // Typing goes to the number: it is selected, and receives the key.
      event.stopPropagation();
      this.#number.focus();
      this.#number.select();
    }
  }

  #listenToNumber(): void {
    const commit = () => {
      const value = parseTyped(this.#number.value, this.#range);
      if (value !== undefined) this.#turn(value);
      this.#listeners.onSettle();
      this.#number.value = this.#shown;
    };
    this.#number.addEventListener("focus", () => this.#number.select());
    this.#number.addEventListener("change", commit);
    this.#number.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Enter") commit();
      if (event.key === "Escape") {
        this.#number.value = this.#shown;
        this.#dial.focus();
      }
    });
  }
}
