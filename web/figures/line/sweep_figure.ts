/** The error of a free-running prediction over the weight of the ridge. */

import { stepped } from "../../ui/controls/dial";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, decadesOf, extentOf, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import { LAMBDAS, measureLine, sweepOf } from "./line_measure";
import { LINE_FIELDS, LINE_RANGES, type LineState } from "./line_state";

/** Step of an arrow key, as a share of the range; with Shift the fine one. */
const STEP = 0.02;
const FINE_STEP = 0.005;
/** Minimum range of the errors, degrees. */
const LEAST_EXTENT = 0.1;

export const SWEEP: FigureKind<LineState> = {
  fields: LINE_FIELDS,
  create: (parts) => new SweepFigure(parts),
};

class SweepFigure implements FigureInstance<LineState> {
  readonly #parts: FigureParts<LineState>;
  readonly #frame: PlotFrame;
  readonly #curve = svg("path", { class: "curve chosen" });
  readonly #handle: Handle;
  readonly #point = svg("circle", { class: "query", r: 5 });
  readonly #readout = html("p", { class: "readout" });
  readonly #sweeping = new Latest<LineState>((state) => this.#sweep(state));
  #state: LineState | undefined;
  #swept: { key: string; errors: number[] } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<LineState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.sweep.title, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.line.knobs.lambda.name,
      "lambda",
      picture,
      {
        value: () => this.#axes && this.#state?.lambda,
        valueOf: (x) => valueOfX(this.#axes!, x),
        stepped: (lambda, direction, fine) =>
          stepped(lambda, direction * (fine ? FINE_STEP : STEP), LINE_RANGES.lambda),
        ends: () => [LINE_RANGES.lambda.min, LINE_RANGES.lambda.max],
        onInput: (lambda) => change({ lambda: Number(lambda.toFixed(LINE_RANGES.lambda.digits)) }, false),
        onSettle: () => change({}, true),
      },
      signal,
    );
    picture.append(this.#curve, this.#point, this.#handle.element);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.sweep.title)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: LineState): Promise<void> {
    this.#state = state;
    this.#draw();
    return this.#sweeping.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureLine(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const now = this.#now();
    if (!now) return "";
    const { words } = this.#parts;
    const { lambda, error, least, best } = now;
    const degrees = (value: number) => figure(value, 2, words);
    return words.sweep.said(figure(lambda, 4, words), degrees(error), degrees(least), figure(best, 4, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = (this.#swept?.errors ?? []).map((error, i) => [
      figure(LAMBDAS[i]!, 4, words),
      figure(error, 3, words),
    ]);
    return { head: words.sweep.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    const { words } = this.#parts;
    return this.#state ? { lambda: figure(this.#state.lambda, 4, words) } : {};
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  async #sweep(state: LineState): Promise<void> {
    // λ and the instant do not change the curve.
    const key = JSON.stringify({ ...state, lambda: 0, at: 0 });
    if (this.#swept?.key === key) return;
    const errors = await sweepOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#swept = { key, errors };
    this.#draw();
  }

  /** The error at the state's λ, interpolated from the curve. */
  #now() {
    const [state, swept] = [this.#state, this.#swept];
    if (!state || !swept) return undefined;
    const { errors } = swept;
    const share = (Math.log10(state.lambda) + 4) * ((LAMBDAS.length - 1) / 5);
    const i = Math.min(LAMBDAS.length - 2, Math.max(0, Math.floor(share)));
    const error = errors[i]! + (errors[i + 1]! - errors[i]!) * Math.min(1, share - i);
    const least = Math.min(...errors);
    return { lambda: state.lambda, error, least, best: LAMBDAS[errors.indexOf(least)]!, errors };
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const now = this.#now();
    if (!now) return;
    const { words } = this.#parts;
    const { errors, lambda, error, least, best } = now;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [LINE_RANGES.lambda.min, LINE_RANGES.lambda.max],
      y: extentOf(errors, LEAST_EXTENT),
      logX: true,
    };
    this.#axes = axes;
    const columns = decadesOf(axes.x).map(
      (value) => [value, value < 1 ? figure(value, -Math.log10(value), words) : `${value}`] as const,
    );
    this.#frame.drawGrid(axes, { x: "λ", y: words.sweep.error, columns, rows: ticksOf(axes.y, 4) }, words);
    const points = errors.map((value, i) => `${xOf(axes, LAMBDAS[i]!).toFixed(1)} ${yOf(axes, value).toFixed(1)}`);
    setAttributes(this.#curve, { d: `M${points.join("L")}` });
    setAttributes(this.#point, { cx: xOf(axes, lambda), cy: yOf(axes, error) });
    const [x, bottom] = [xOf(axes, lambda), yOf(axes, axes.y[0])];
    this.#handle.place({ x, bottom, value: lambda, text: this.sentence() });
    setText(this.#readout, words.sweep.read(figure(error, 2, words), figure(least, 2, words), figure(best, 3, words)));
  }
}
