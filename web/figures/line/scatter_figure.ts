/** One degree of freedom of the nearest examples: target over input, with the fitted line. */
import type { Fit } from "../../client/learn/protocol";
import { DEGREES, ROLES, type Role } from "../../humanoid";
import { Toggle } from "../../ui/controls/buttons";
import type { Knob } from "../../ui/controls/knob";
import type { Slider } from "../../ui/controls/slider";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, digitsOf, extentOf, ticksOf, xOf, yOf } from "../axes";
import { Choice, createInstant, createKnobs } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./line.css?inline";
import { aboveMean, fitOf, measureLine, residual } from "./line_measure";
import { LINE_FIELDS, LINE_RANGES, type LineState } from "./line_state";

/** Minimum range of an axis, degrees: among equal examples every hundredth would fill the picture. */
const LEAST_EXTENT = 2;
/** Radius of an example with weight 0 and with weight 1, pixels. */
const RADIUS = { least: 2, most: 6 };
/** Rows of the table. */
const TABLE_ROWS = 12;
/** Terms that highlight the dots. */
const ON_DOTS: readonly string[] = ["x", "y", "v", "K"];

/** Knobs of the figure. */
const KNOBS = ["k", "lambda", "noise"] as const;
type KnobName = (typeof KNOBS)[number];

export const SCATTER: FigureKind<LineState> = {
  fields: LINE_FIELDS,
  sheet,
  create: (parts) => new ScatterFigure(parts),
};

class ScatterFigure implements FigureInstance<LineState> {
  readonly #parts: FigureParts<LineState>;
  readonly #frame: PlotFrame;
  readonly #joint: Choice<Role>;
  readonly #knobs: Record<KnobName, Knob>;
  readonly #taper: Toggle;
  readonly #instant: Slider;
  readonly #readout = html("p", { class: "readout" });
  readonly #band = svg("path", { class: "band" });
  readonly #mean = svg("path", { class: "mean" });
  /** A single path: all dots change at once. */
  readonly #dots = svg("path", { class: "dots", "data-term": "v" });
  readonly #line = svg("path", { class: "fit", "data-term": "c" });
  readonly #guide = svg("path", { class: "guide", "data-term": "x" });
  readonly #point = svg("circle", { class: "query", r: 5, "data-term": "y" });
  readonly #labels = {
    x: svg("text", { class: "label x", "data-term": "x" }),
    y: svg("text", { class: "label y", "data-term": "y" }),
  };
  readonly #fitting = new Latest<LineState>((state) => this.#fit(state));
  #state: LineState | undefined;
  #fitted: { state: LineState; fit: Fit } | undefined;

  constructor(parts: FigureParts<LineState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.line.title, () => this.#drawNow(), signal);
    this.#joint = new Choice(
      words.joint,
      ROLES.map((role) => [role, words.joints[role]] as const),
      (joint) => change({ joint }, true),
    );
    this.#knobs = createKnobs(KNOBS, words, words.line.knobs, LINE_RANGES, LINE_FIELDS, change);
    this.#taper = new Toggle(words.line.taper, (taper) => change({ taper }, true));
    this.#instant = createInstant(words, 2, change);
    this.#frame.picture.append(this.#band, this.#mean, this.#dots, this.#line, this.#guide, this.#point);
    this.#frame.picture.append(...Object.values(this.#labels));
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.line.title), this.#joint.element),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html(
        "div",
        { class: "knobs" },
        ...KNOBS.map((name) => this.#knobs[name].element),
        html("div", { class: "others" }, this.#taper.element, this.#instant.element),
      ),
    );
  }

  show(state: LineState): Promise<void> {
    this.#state = state;
    this.#joint.value = state.joint;
    for (const name of KNOBS) this.#knobs[name].value = state[name];
    this.#taper.on = state.taper;
    this.#instant.value = state.at;
    return this.#fitting.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureLine(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#fitted) return "";
    const { fit, state } = this.#fitted;
    const { words } = this.#parts;
    const degrees = (value: number) => figure(value, 1, words);
    return words.line.said(
      words.joints[state.joint],
      String(fit.rows.length),
      degrees(fit.query[2] * DEGREES),
      degrees(fit.predicted * DEGREES),
      figure(fit.beta[2], 2, words),
      figure(aboveMean(fit), 2, words),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const fit = this.#fitted?.fit;
    const degrees = (value: number) => figure(value * DEGREES, 1, words);
    const rows = Array.from({ length: Math.min(TABLE_ROWS, fit?.rows.length ?? 0) }, (_, i) => [
      String(fit!.rows[i]),
      degrees(fit!.x[i]!),
      degrees(fit!.y[i]!),
      figure(fit!.weights[i]!, 2, words),
    ]);
    return { head: words.line.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#fitted) return {};
    const { fit, state } = this.#fitted;
    const { words } = this.#parts;
    const degrees = (value: number) => `${figure(value * DEGREES, 1, words)}°`;
    const [a, b, c] = fit.beta;
    const d = fit.means.y - a * fit.means.xPrevious - b * fit.means.yPrevious - c * fit.means.x;
    return {
      x: degrees(fit.query[2]),
      y: degrees(fit.predicted),
      a: figure(a, 2, words),
      b: figure(b, 2, words),
      c: figure(c, 2, words),
      d: degrees(d),
      K: String(fit.rows.length),
      lambda: figure(state.lambda, state.lambda < 0.01 ? 4 : 2, words),
      v: `V ${figure(
        fit.weights.reduce((sum, weight) => sum + weight, 0),
        1,
        words,
      )}`,
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    // The dots are pairs of x and y, and there are K of them.
    this.#dots.classList.toggle("lit", term !== undefined && ON_DOTS.includes(term));
    const knobs: Readonly<Record<string, KnobName>> = { K: "k", lambda: "lambda" };
    for (const [of, name] of Object.entries(knobs)) this.#knobs[name].element.classList.toggle("lit", of === term);
  }

  async #fit(state: LineState): Promise<void> {
    const fit = await fitOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#fitted = { state, fit };
    this.#draw();
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#fitted) return;
    const { words } = this.#parts;
    const { fit, state } = this.#fitted;
    const [xs, ys] = [fit.x, fit.y].map((values) => Array.from(values, (value) => value * DEGREES)) as [
      number[],
      number[],
    ];
    const [x, y, mean] = [fit.query[2], fit.predicted, fit.means.y].map((value) => value * DEGREES) as Three;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: extentOf([...xs, x], LEAST_EXTENT),
      y: extentOf([...ys, y], LEAST_EXTENT),
    };
    const ticks = ticksOf(axes.x, 5);
    const name = words.joints[state.joint];
    this.#frame.drawGrid(
      axes,
      {
        x: words.line.input(name),
        y: words.line.output(name, words.styles[state.style]),
        columns: ticks.map((value) => [value, `${figure(value, digitsOf(ticks), words)}°`]),
        rows: ticksOf(axes.y, 4),
      },
      words,
    );
    this.#drawDots(axes, xs, ys, fit.weights);
    this.#drawLine(axes, fit, x, y);
    setAttributes(this.#mean, { d: `M${xOf(axes, axes.x[0])} ${yOf(axes, mean)}H${xOf(axes, axes.x[1])}` });
    const [px, py] = [xOf(axes, x), yOf(axes, y)];
    setAttributes(this.#point, { cx: px, cy: py });
    setAttributes(this.#guide, { d: `M${px} ${yOf(axes, axes.y[0])}V${py}H${xOf(axes, axes.x[0])}` });
    setAttributes(this.#labels.x, { x: px + 6, y: yOf(axes, axes.y[0]) - 6 });
    // Below its guide if the line approaches from above.
    const isBelow = fit.beta[2] < 0;
    setAttributes(this.#labels.y, { x: xOf(axes, axes.x[0]) + 6, y: py + (isBelow ? 16 : -6) });
    setText(this.#labels.x, `${figure(x, 1, words)}°`);
    setText(this.#labels.y, `${figure(y, 1, words)}°`);
    const above = aboveMean(fit);
    setText(
      this.#readout,
      words.line.read(figure(mean, 1, words), `${above < 0 ? "" : "+"}${figure(above, 2, words)}`),
    );
  }

  #drawDots(axes: Axes, xs: readonly number[], ys: readonly number[], weights: Float32Array): void {
    const dot = (value: number, i: number) =>
      circle(xOf(axes, value), yOf(axes, ys[i]!), RADIUS.least + (RADIUS.most - RADIUS.least) * weights[i]!);
    setAttributes(this.#dots, { d: xs.map(dot).join("") });
  }

  /** The line with the query's other terms passes through the prediction. */
  #drawLine(axes: Axes, fit: Fit, x: number, y: number): void {
    const [from, to] = axes.x;
    const at = (value: number) => y + fit.beta[2] * (value - x);
    const spread = residual(fit);
    const ends = (offset: number) => [from, to].map((value) => `${xOf(axes, value)} ${yOf(axes, at(value) + offset)}`);
    setAttributes(this.#line, { d: `M${ends(0).join("L")}` });
    setAttributes(this.#band, { d: `M${ends(spread).join("L")}L${ends(-spread).reverse().join("L")}Z` });
  }
}

/** The path of a circle. */
function circle(x: number, y: number, radius: number): string {
  const [r, across] = [radius.toFixed(1), (2 * radius).toFixed(1)];
  return `M${(x - radius).toFixed(1)} ${y.toFixed(1)}a${r} ${r} 0 1 0 ${across} 0a${r} ${r} 0 1 0 -${across} 0z`;
}

type Three = [number, number, number];
