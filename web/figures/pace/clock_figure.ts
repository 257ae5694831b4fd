/** Output time of a blend over input time. */
import { setAttributes, setText, svg } from "../../ui/dom";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./pace.css?inline";
import { lengthOf, measurePace, type Paced, pacedOf, ratioOf } from "./pace_measure";
import { PACE_FIELDS, type PaceState } from "./pace_state";

/** Step of an arrow key, frames; with Shift one frame. */
const STEP = 10;
/** Frames between two rows of the table. */
const TABLE_STEP = 60;
/** Minimum range of the output axis, relative to the input's length, so that it does not change with the weights. */
const REACH = 1.6;

export const CLOCK: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  measure: measurePace,
  sheet,
  create: (parts) => new ClockFigure(parts),
};

class ClockFigure extends PlotFigure<PaceState, Paced> {
  readonly #even = svg("path", { class: "even" });
  readonly #curve = svg("path", { class: "clock", "data-term": "w" });
  readonly #guide = svg("path", { class: "guide" });
  readonly #point = svg("circle", { class: "query", r: 5, "data-term": "w" });
  readonly #handle = this.playhead("at", {
    step: STEP,
    rate: () => this.shown!.input.rateHz,
    ends: () => [2, (this.shown?.styled.timeOut.length ?? 3) - 1],
  });
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<PaceState>) {
    const { clock } = parts.words.pace;
    super(parts, clock);
    const { picture, element } = this.frame;
    picture.append(this.#even, this.#curve, this.#guide, this.#handle.element, this.#point);
    // Hidden until it has a position.
    setAttributes(this.#handle.element, { visibility: "hidden" });
    this.lay({ title: clock, picture: element });
  }

  protected load(state: PaceState): Promise<Paced> {
    return pacedOf(this.parts.engine, state);
  }

  protected describe(paced: Paced, state: PaceState): string {
    const { input, styled } = paced;
    const at = frameOf(paced, state);
    return this.words.pace.clocked(
      this.number(at / input.rateHz, 2),
      this.number(styled.timeOut[at]!, 2),
      this.number(lengthOf(paced), 2),
      this.number(ratioOf(paced), 3),
    );
  }

  protected get columns() {
    return this.words.pace.times;
  }

  protected rows({ input, styled: { timeOut } }: Paced): string[][] {
    return Array.from({ length: Math.ceil(timeOut.length / TABLE_STEP) }, (_, i) => {
      const at = i * TABLE_STEP;
      return [this.number(at / input.rateHz, 2), this.number(timeOut[at]!, 2)];
    });
  }

  protected override quantities(paced: Paced, state: PaceState) {
    const { timeOut } = paced.styled;
    const at = frameOf(paced, state);
    return { w: `${this.number(1000 * (timeOut[at]! - timeOut[at - 1]!), 1)} ms` };
  }

  protected draw(paced: Paced, state: PaceState): void {
    const { input, styled, secs } = paced;
    const at = frameOf(paced, state);
    const { pace } = this.words;
    const axes = this.plot(
      { min: 0, max: secs },
      { min: 0, max: Math.max(REACH * secs, lengthOf(paced)) },
      { x: pace.input, y: pace.output, columns: 6, digits: 0, rows: 5 },
    );
    setAttributes(this.#even, { d: `M${axes.x(0)} ${axes.y(0)}L${axes.x(secs)} ${axes.y(secs)}` });
    setAttributes(this.#curve, { d: axes.curve(styled.timeOut, input.rateHz) });
    const [x, y] = [axes.x(at / input.rateHz), axes.y(styled.timeOut[at]!)];
    setAttributes(this.#point, { cx: x, cy: y });
    setAttributes(this.#guide, { d: `M${x} ${y}H${axes.x(0)}` });
    setAttributes(this.#handle.element, { visibility: "visible" });
    this.#handle.place({ x, bottom: axes.y(0), value: at, text: `${this.number(at / input.rateHz, 2)} s` });
    const two = (value: number) => this.number(value, 2);
    setText(this.readout, this.words.pace.read(two(lengthOf(paced)), two(secs), this.number(ratioOf(paced), 3)));
  }
}

/** The displayed frame: an input may be shorter than the frame in a link. */
function frameOf({ styled }: Paced, { at }: PaceState): number {
  return Math.min(at, styled.timeOut.length - 1);
}
