/** The playhead of a timeline: a slider, moved by the timeline's drags, its clock and the keyboard. */
import { setAttributes, svg } from "../../../ui/dom";

export interface PlayheadOptions {
  label: string;
  /** Vertical position of the ruler at which the playhead points, units. */
  rulerY: number;
  /** Step of an arrow key, in the units of the timeline. */
  step: number;
  onSeek: (value: number) => void;
}

/** Position of the playhead. */
interface PlayheadPlace {
  value: number;
  max: number;
  /** Position of the value, units. */
  x: number;
  /** The value as text. */
  text: string;
}

export class Playhead {
  readonly element: SVGGElement;
  readonly #line: SVGLineElement;
  readonly #options: PlayheadOptions;
  #value = 0;
  #max = 0;

  constructor(options: PlayheadOptions) {
    this.#options = options;
    const { label, rulerY } = options;
    this.#line = svg("line", { y1: rulerY - 6 });
    this.element = svg(
      "g",
      { class: "editor-head", role: "slider", tabindex: 0, "aria-label": label, "aria-valuemin": 0 },
      this.#line,
      svg("path", { d: `M-6 ${rulerY - 16}h12v8l-6 6-6-6z` }),
      svg("rect", { class: "editor-grip", x: -12, y: rulerY - 24, width: 24, height: 28 }),
    );
    this.element.addEventListener("keydown", (event) => this.#onKey(event));
  }

  /** Sets the lower end of the line, units from the top. */
  set bottom(y: number) {
    this.#line.setAttribute("y2", String(y));
  }

  place({ value, max, x, text }: PlayheadPlace): void {
    [this.#value, this.#max] = [value, max];
    setAttributes(this.element, {
      transform: `translate(${x.toFixed(1)} 0)`,
      "aria-valuenow": Number(value.toFixed(2)),
      "aria-valuemax": Number(max.toFixed(2)),
      "aria-valuetext": text,
    });
  }

  focus(): void {
    this.element.focus({ preventScroll: true });
  }

  #onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { step, onSeek } = this.#options;
    const to = {
      ArrowRight: this.#value + step,
      ArrowUp: this.#value + step,
      ArrowLeft: this.#value - step,
      ArrowDown: this.#value - step,
      Home: 0,
      End: this.#max,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    // Another key may be pressed before the playhead is placed again.
    this.#value = Math.min(this.#max, Math.max(0, to));
    onSeek(this.#value);
  }
}
