/** Handles of a plot that can be dragged in both directions, or moved with the arrow keys. */
import { setAttributes, svg } from "../ui/dom";
import { listenToDrags } from "../ui/drag";
import { placeIn } from "../ui/drawing";
import type { Axes } from "./axes";

/** A position in the units of the axes. */
export type Place = readonly [x: number, y: number];

/** Radius of a mark, and of its touch target, units. */
const RADIUS = { mark: 6, target: 22 };

interface PlaneListeners {
  /** The axes in which the handles were placed; `undefined` before. */
  axes: () => Axes | undefined;
  onInput: (which: number, place: Place) => void;
  /** Called when the pointer is released; the figure's element handles keys. */
  onSettle: () => void;
}

export class PlaneHandles {
  readonly elements: readonly SVGGElement[];
  readonly #picture: SVGSVGElement;
  readonly #listeners: PlaneListeners;
  readonly #step: (fine: boolean) => number;
  #places: readonly Place[] = [];

  /**
   * @param names name of each handle
   * @param step step of an arrow key, in the units of the axes
   */
  constructor(
    picture: SVGSVGElement,
    names: readonly string[],
    step: (fine: boolean) => number,
    listeners: PlaneListeners,
    signal: AbortSignal,
  ) {
    this.#picture = picture;
    this.#step = step;
    this.#listeners = listeners;
    this.elements = names.map((name, which) => {
      const mark = svg(
        "g",
        { class: "anchor", role: "slider", tabindex: 0, "aria-label": name },
        svg("circle", { class: "target", r: RADIUS.target }),
        svg("circle", { class: "mark", r: RADIUS.mark }),
      );
      listenToDrags(mark, (press) => this.#drag(which, press), signal);
      // Otherwise a press would also move the element beneath.
      mark.addEventListener("pointerdown", (event) => event.stopPropagation(), { signal });
      mark.addEventListener("keydown", (event) => this.#key(which, event), { signal });
      return mark;
    });
  }

  /** @param say converts a position to text */
  place(axes: Axes, places: readonly Place[], say: (place: Place) => string): void {
    this.#places = places;
    places.forEach((place, which) => {
      const [x, y] = place;
      setAttributes(this.elements[which]!, {
        transform: `translate(${axes.x(x).toFixed(1)} ${axes.y(y).toFixed(1)})`,
        "aria-valuemin": axes.up.min,
        "aria-valuemax": axes.up.max,
        "aria-valuenow": Number(y.toFixed(2)),
        "aria-valuetext": say(place),
      });
    });
  }

  #drag(which: number, press: PointerEvent) {
    const [axes, before] = [this.#listeners.axes(), this.#places[which]];
    if (!axes || !before) return undefined;
    press.preventDefault();
    this.elements[which]!.focus({ preventScroll: true });
    const pressed = placeIn(this.#picture, press);
    const grip = { x: pressed.x - axes.x(before[0]), y: pressed.y - axes.y(before[1]) };
    const move = (event: PointerEvent) => {
      const { x, y } = placeIn(this.#picture, event);
      this.#listeners.onInput(which, [axes.valueAtX(x - grip.x), axes.valueAtY(y - grip.y)]);
    };
    return {
      move,
      cancel: () => this.#listeners.onInput(which, before),
      end: () => this.#listeners.onSettle(),
    };
  }

  #key(which: number, event: KeyboardEvent): void {
    const place = this.#places[which];
    if (!place || event.ctrlKey || event.metaKey || event.altKey) return;
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    const step = this.#step(event.shiftKey);
    const next: Place = [place[0] + step * by[0]!, place[1] + step * by[1]!];
    // The next key may come before the next picture.
    this.#places = this.#places.map((one, i) => (i === which ? next : one));
    this.#listeners.onInput(which, next);
  }
}
