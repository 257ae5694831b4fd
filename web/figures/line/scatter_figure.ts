/** One degree of freedom of the nearest examples: target over input, with the fitted line. */
import type { Fit } from "../../client/learn/protocol";
import { DEGREES, ROLES } from "../../humanoid";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { Axes } from "../axes";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./line.css?inline";
import { aboveMean, fitOf, measureLine, residual } from "./line_measure";
import { LINE_FIELDS, LINE_RANGES, type LineState } from "./line_state";

/** Minimum range of an axis, degrees: among equal examples every hundredth would fill the picture. */
const LEAST_EXTENT = 2;
/** Radius of an example with weight 0 and with weight 1, pixels. */
const RADIUS = { least: 2, most: 6 };
/** Rows of the table. */
const TABLE_ROWS = 12;
/** Terms that highlight the dots, which are pairs of x and y: there are K of them. */
const ON_DOTS: readonly string[] = ["x", "y", "v", "K"];

export const SCATTER: FigureKind<LineState> = {
  fields: LINE_FIELDS,
  measure: measureLine,
  sheet,
  create: (parts) => new ScatterFigure(parts),
};

interface Shown {
  state: LineState;
  fit: Fit;
}

class ScatterFigure extends PlotFigure<LineState, Shown> {
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

  constructor(parts: FigureParts<LineState>) {
    const { line, joint, joints } = parts.words;
    super(parts, line.title);
    const { picture, element } = this.frame;
    picture.append(this.#band, this.#mean, this.#dots, this.#line, this.#guide, this.#point);
    picture.append(...Object.values(this.#labels));
    this.lay({
      title: line.title,
      picture: element,
      head: [this.choice("joint", joint, ROLES, (role) => joints[role])],
      controls: [
        ...this.knobs(["k", "lambda", "noise"], line.knobs, LINE_RANGES, { k: "K", lambda: "lambda" }),
        html("div", { class: "others" }, this.toggle("taper", line.taper), this.instant("at", 2)),
      ],
    });
  }

  override light(term: string | undefined): void {
    super.light(term);
    this.#dots.classList.toggle("lit", term !== undefined && ON_DOTS.includes(term));
  }

  protected async load(state: LineState): Promise<Shown> {
    return { state, fit: await fitOf(this.parts.engine, state) };
  }

  protected describe({ fit, state }: Shown): string {
    return this.words.line.said(
      this.words.joints[state.joint],
      String(fit.rows.length),
      this.#degrees(fit.query[2]),
      this.#degrees(fit.predicted),
      this.number(fit.beta[2], 2),
      this.number(aboveMean(fit), 2),
    );
  }

  protected get columns() {
    return this.words.line.columns;
  }

  protected rows({ fit }: Shown): string[][] {
    return Array.from({ length: Math.min(TABLE_ROWS, fit.rows.length) }, (_, i) => [
      String(fit.rows[i]),
      this.#degrees(fit.x[i]!),
      this.#degrees(fit.y[i]!),
      this.number(fit.weights[i]!, 2),
    ]);
  }

  protected override quantities({ fit, state }: Shown) {
    const [a, b, c] = fit.beta;
    const d = fit.means.y - a * fit.means.xPrevious - b * fit.means.yPrevious - c * fit.means.x;
    const weight = fit.weights.reduce((sum, one) => sum + one, 0);
    return {
      x: `${this.#degrees(fit.query[2])}°`,
      y: `${this.#degrees(fit.predicted)}°`,
      a: this.number(a, 2),
      b: this.number(b, 2),
      c: this.number(c, 2),
      d: `${this.#degrees(d)}°`,
      K: String(fit.rows.length),
      lambda: this.number(state.lambda, state.lambda < 0.01 ? 4 : 2),
      v: `V ${this.number(weight, 1)}`,
    };
  }

  #degrees(radians: number): string {
    return this.number(radians * DEGREES, 1);
  }

  protected draw({ fit, state }: Shown): void {
    const [xs, ys] = [fit.x, fit.y].map((values) => Array.from(values, (value) => value * DEGREES)) as [
      number[],
      number[],
    ];
    const [x, y, mean] = [fit.query[2], fit.predicted, fit.means.y].map((value) => value * DEGREES) as Three;
    const { line, joints, styles } = this.words;
    const name = joints[state.joint];
    const axes = this.plot(roundedExtent([...xs, x], LEAST_EXTENT), roundedExtent([...ys, y], LEAST_EXTENT), {
      x: line.input(name),
      y: line.output(name, styles[state.style]),
      columns: 5,
      unit: "°",
      rows: 4,
    });
    this.#drawDots(axes, xs, ys, fit.weights);
    this.#drawLine(axes, fit, x, y);
    setAttributes(this.#mean, { d: `M${axes.left} ${axes.y(mean)}H${axes.right}` });
    const [px, py] = [axes.x(x), axes.y(y)];
    setAttributes(this.#point, { cx: px, cy: py });
    setAttributes(this.#guide, { d: `M${px} ${axes.bottom}V${py}H${axes.left}` });
    setAttributes(this.#labels.x, { x: px + 6, y: axes.bottom - 6 });
    // Below its guide if the line approaches from above.
    const isBelow = fit.beta[2] < 0;
    setAttributes(this.#labels.y, { x: axes.left + 6, y: py + (isBelow ? 16 : -6) });
    setText(this.#labels.x, `${this.number(x, 1)}°`);
    setText(this.#labels.y, `${this.number(y, 1)}°`);
    const above = aboveMean(fit);
    setText(
      this.readout,
      this.words.line.read(this.number(mean, 1), `${above < 0 ? "" : "+"}${this.number(above, 2)}`),
    );
  }

  #drawDots(axes: Axes, xs: readonly number[], ys: readonly number[], weights: Float32Array): void {
    const dot = (value: number, i: number) =>
      circle(axes.x(value), axes.y(ys[i]!), RADIUS.least + (RADIUS.most - RADIUS.least) * weights[i]!);
    setAttributes(this.#dots, { d: xs.map(dot).join("") });
  }

  /** The line with the query's other terms passes through the prediction. */
  #drawLine(axes: Axes, fit: Fit, x: number, y: number): void {
    const { min, max } = axes.across;
    const at = (value: number) => y + fit.beta[2] * (value - x);
    const spread = residual(fit);
    const ends = (offset: number) => [min, max].map((value) => `${axes.x(value)} ${axes.y(at(value) + offset)}`);
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
