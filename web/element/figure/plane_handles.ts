/** Handles of a plot that are dragged in both directions, or moved with the arrow keys. */
import { setAttributes, svg } from "../../ui/dom";
import { listenToDrags } from "../../ui/drag";
import { placeIn } from "../../ui/drawing";
import { type Axes, valueOfX, valueOfY, xOf, yOf } from "./axes";

/** A place in the units of the axes. */
export type Place = readonly [x: number, y: number];

/** Radius of a mark, and of what a finger takes hold of, units. */
const RADIUS = { mark: 6, target: 22 };

export interface PlaneListeners {
  /** The axes that the handles were placed in; `undefined` before. */
  axes: () => Axes | undefined;
  onInput: (which: number, place: Place) => void;
  /** The pointer has let go; of keys the figure's element knows. */
  onSettle: () => void;
}

export class PlaneHandles {
  readonly elements: readonly SVGGElement[];
  readonly #picture: SVGSVGElement;
  readonly #listeners: PlaneListeners;
  readonly #step: (fine: boolean) => number;
  #places: readonly Place[] = [];

  /**
   * @param names what each is called
   * @param step how far an arrow key goes, in the units of the axes
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
      // What lies beneath is moved by a press, too.
      mark.addEventListener("pointerdown", (event) => event.stopPropagation(), { signal });
      mark.addEventListener("keydown", (event) => this.#key(which, event), { signal });
      return mark;
    });
  }

  /** @param say what is said of a place */
  place(axes: Axes, places: readonly Place[], say: (place: Place) => string): void {
    this.#places = places;
    places.forEach((place, which) => {
      const [x, y] = place;
      setAttributes(this.elements[which]!, {
        transform: `translate(${xOf(axes, x).toFixed(1)} ${yOf(axes, y).toFixed(1)})`,
        "aria-valuemin": axes.y[0],
        "aria-valuemax": axes.y[1],
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
    const grip = { x: pressed.x - xOf(axes, before[0]), y: pressed.y - yOf(axes, before[1]) };
    const move = (event: PointerEvent) => {
      const { x, y } = placeIn(this.#picture, event);
      this.#listeners.onInput(which, [valueOfX(axes, x - grip.x), valueOfY(axes, y - grip.y)]);
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
