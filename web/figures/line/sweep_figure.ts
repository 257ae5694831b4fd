/** The error of a free-running prediction over the weight of the ridge. */
import { stepped } from "../../ui/controls/dial";
import { setAttributes, setText, svg } from "../../ui/dom";
import { decades, roundedExtent } from "../../ui/scale";
import { Handle } from "../handle";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import { LAMBDAS, measureLine, sweepOf } from "./line_measure";
import { LINE_FIELDS, LINE_RANGES, type LineState } from "./line_state";

/** Step of an arrow key, as a share of the range; with Shift the fine one. */
const STEP = 0.02;
const FINE_STEP = 0.005;
/** Minimum range of the errors, degrees. */
const LEAST_EXTENT = 0.1;

export const SWEEP: FigureKind<LineState> = {
  fields: LINE_FIELDS,
  measure: measureLine,
  create: (parts) => new SweepFigure(parts),
};

interface Shown {
  key: string;
  errors: number[];
}

class SweepFigure extends PlotFigure<LineState, Shown> {
  readonly #curve = svg("path", { class: "curve chosen" });
  readonly #handle: Handle;
  readonly #point = svg("circle", { class: "query", r: 5 });
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<LineState>) {
    const { sweep, line } = parts.words;
    super(parts, sweep.title);
    const { picture, element } = this.frame;
    const { min, max, digits } = LINE_RANGES.lambda;
    this.#handle = new Handle(
      line.knobs.lambda.name,
      "lambda",
      picture,
      {
        value: () => this.axes && this.state?.lambda,
        valueOf: (x) => this.axes!.valueAtX(x),
        stepped: (lambda, direction, fine) =>
          stepped(lambda, direction * (fine ? FINE_STEP : STEP), LINE_RANGES.lambda),
        ends: () => [min, max],
        onInput: (lambda) => this.change({ lambda: Number(lambda.toFixed(digits)) }, false),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    picture.append(this.#curve, this.#point, this.#handle.element);
    this.lay({ title: sweep.title, picture: element });
  }

  protected async load(state: LineState): Promise<Shown> {
    // λ and the instant do not change the curve.
    const key = JSON.stringify({ ...state, lambda: 0, at: 0 });
    return this.shown?.key === key ? this.shown : { key, errors: await sweepOf(this.parts.engine, state) };
  }

  protected describe({ errors }: Shown, { lambda }: LineState): string {
    const { error, least, best } = errorsAt(errors, lambda);
    return this.words.sweep.said(
      this.number(lambda, 4),
      this.number(error, 2),
      this.number(least, 2),
      this.number(best, 4),
    );
  }

  protected get columns() {
    return this.words.sweep.columns;
  }

  protected rows({ errors }: Shown): string[][] {
    return errors.map((error, i) => [this.number(LAMBDAS[i]!, 4), this.number(error, 3)]);
  }

  protected override quantities(_: Shown, { lambda }: LineState) {
    return { lambda: this.number(lambda, 4) };
  }

  protected draw({ errors }: Shown, { lambda }: LineState): void {
    const { error, least, best } = errorsAt(errors, lambda);
    const columns = decades(LINE_RANGES.lambda).map(
      (value) => [value, value < 1 ? this.number(value, -Math.log10(value)) : `${value}`] as const,
    );
    const labels = { x: "λ", y: this.words.sweep.error, columns, rows: 4 };
    const axes = this.plot(LINE_RANGES.lambda, roundedExtent(errors, LEAST_EXTENT), labels, { logX: true });
    const points = errors.map((value, i) => axes.at(LAMBDAS[i]!, value));
    setAttributes(this.#curve, { d: `M${points.join("L")}` });
    setAttributes(this.#point, { cx: axes.x(lambda), cy: axes.y(error) });
    const [x, bottom] = [axes.x(lambda), axes.bottom];
    this.#handle.place({ x, bottom, value: lambda, text: this.sentence() });
    setText(this.readout, this.words.sweep.read(this.number(error, 2), this.number(least, 2), this.number(best, 3)));
  }
}

/** The error at a λ, interpolated from the curve, and the least one with its λ. */
function errorsAt(errors: readonly number[], lambda: number) {
  const share = (Math.log10(lambda) + 4) * ((LAMBDAS.length - 1) / 5);
  const i = Math.min(LAMBDAS.length - 2, Math.max(0, Math.floor(share)));
  const error = errors[i]! + (errors[i + 1]! - errors[i]!) * Math.min(1, share - i);
  const least = Math.min(...errors);
  return { error, least, best: LAMBDAS[errors.indexOf(least)]! };
}
