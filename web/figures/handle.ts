/** The handle of a plot: a vertical line that can be dragged, or moved with the arrow keys. */
import { setAttributes, svg } from "../ui/dom";
import { listenToDrags } from "../ui/drag";
import { placeIn } from "../ui/drawing";

export interface HandleListeners {
  /** Its current value; `undefined` while it cannot be moved. */
  value: () => number | undefined;
  /** The value at a position of the picture, units from its left. */
  valueOf: (x: number) => number;
  /** The value one step in a direction, −1 or 1. */
  stepped: (value: number, direction: number, fine: boolean) => number;
  ends: () => readonly [min: number, max: number];
  onInput: (value: number) => void;
  /** Called when the pointer is released; the figure's element handles keys. */
  onSettle: () => void;
}

/** Position of a handle, and its text. */
interface HandlePlace {
  x: number;
  /** Lower end of the line. */
  bottom: number;
  value: number;
  text: string;
}

export class Handle {
  readonly element = svg("g", { class: "playhead", role: "slider", tabindex: 0 });
  readonly #target = svg("path", { class: "target" });
  readonly #line = svg("path", { class: "line" });
  readonly #listeners: HandleListeners;

  /** @param picture element in which a press moves the handle */
  constructor(name: string, term: string, picture: SVGSVGElement, listeners: HandleListeners, signal: AbortSignal) {
    this.#listeners = listeners;
    this.element.append(this.#target, this.#line, svg("path", { class: "flag", d: "M-5 0h10v7l-5 5l-5-5z" }));
    setAttributes(this.element, { "aria-label": name, "data-term": term });
    listenToDrags(picture, (press) => this.#drag(picture, press), signal);
    this.element.addEventListener("keydown", (event) => this.#key(event), { signal });
  }

  place({ x, bottom, value, text }: HandlePlace): void {
    const [min, max] = this.#listeners.ends();
    setAttributes(this.element, {
      transform: `translate(${x} 0)`,
      "aria-valuemin": min,
      "aria-valuemax": max,
      "aria-valuenow": value,
      "aria-valuetext": text,
    });
    setAttributes(this.#target, { d: `M-22 0h44V${bottom}h-44z` });
    setAttributes(this.#line, { d: `M0 0V${bottom}` });
  }

  #drag(picture: SVGSVGElement, press: PointerEvent) {
    const before = this.#listeners.value();
    if (before === undefined) return undefined;
    const goTo = (event: PointerEvent) => this.#goTo(this.#listeners.valueOf(placeIn(picture, event).x));
    press.preventDefault();
    this.element.focus({ preventScroll: true });
    goTo(press);
    return { move: goTo, cancel: () => this.#goTo(before), end: () => this.#listeners.onSettle() };
  }

  #key(event: KeyboardEvent): void {
    const value = this.#listeners.value();
    if (value === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    const [min, max] = this.#listeners.ends();
    const by = (direction: number) => this.#listeners.stepped(value, direction, event.shiftKey);
    const to = {
      ArrowLeft: () => by(-1),
      ArrowDown: () => by(-1),
      ArrowRight: () => by(1),
      ArrowUp: () => by(1),
      Home: () => min,
      End: () => max,
    }[event.key];
    if (!to) return;
    event.preventDefault();
    this.#goTo(to());
  }

  #goTo(value: number): void {
    const [min, max] = this.#listeners.ends();
    this.#listeners.onInput(Math.min(max, Math.max(min, value)));
  }
}
