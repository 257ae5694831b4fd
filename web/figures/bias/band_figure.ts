/** One degree of freedom on an axis: the band of the neighbours, the part of the input outside it, and the returned part. */
import { keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { Axes } from "../axes";
import { Handle } from "../handle";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./bias.css?inline";
import { type Band, biasOf, measureBias } from "./bias_measure";
import { BIAS_FIELDS, BIAS_JOINT, BIAS_RANGES, type BiasState, NO_GUESS } from "./bias_state";

/** Minimum range of the axis, degrees, so that it does not change while a mark is dragged. */
const ENDS = [-50, 100] as const;
/** Height of the rows, as shares of the picture. */
const ROW = { input: 0.7, output: 0.22 } as const;
/** Half the height of the band and of marks, units. */
const HALF = { band: 22, tick: 12 } as const;
/** Space for the head of an arrow, units. */
const HEAD = 7;
/** Step of an arrow key, degrees; with Shift one degree. */
const STEP = 5;

export const BAND: FigureKind<BiasState> = {
  fields: BIAS_FIELDS,
  measure: measureBias,
  sheet,
  create: (parts) => new BandFigure(parts),
};

interface Shown {
  state: BiasState;
  band: Band;
}

class BandFigure extends PlotFigure<BiasState, Shown> {
  readonly #handle: Handle;
  readonly #band = svg("rect", { class: "band", "data-term": "kappa" });
  readonly #mean = svg("path", { class: "mean", "data-term": "mu" });
  readonly #dots = svg("g", { class: "dots", "data-term": "sigma" });
  readonly #bias = svg("path", { class: "arrow bias", "data-term": "dx" });
  readonly #line = svg("circle", { class: "query", r: 4, "data-term": "beta" });
  readonly #returned = svg("path", { class: "arrow returned", "data-term": "rho" });
  readonly #output = svg("path", { class: "output", "data-term": "y" });
  readonly #labels = { x: svg("text", { class: "label x" }), y: svg("text", { class: "label y" }) };
  readonly #rows = { input: svg("text", { class: "label row" }), output: svg("text", { class: "label row" }) };
  /** The handle follows the pointer at once; everything else waits for the engine. */
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<BiasState>) {
    const { bias } = parts.words;
    super(parts, bias.title);
    const { picture, element } = this.frame;
    this.#handle = new Handle(
      bias.knobs.raise.name,
      "x",
      picture,
      {
        value: () => this.shown && this.state?.raise,
        // The input's angle increases with the raise, degree by degree.
        valueOf: (x) => this.shown!.state.raise + this.axes!.valueAtX(x) - this.shown!.band.x,
        stepped: (raise, direction, fine) => raise + direction * (fine ? 1 : STEP),
        ends: () => [BIAS_RANGES.raise.min, BIAS_RANGES.raise.max],
        onInput: (raise) => this.change({ raise: Math.round(raise) }, false),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    picture.append(this.#band, this.#mean, this.#dots, this.#bias, this.#returned, this.#line, this.#output);
    picture.append(...Object.values(this.#rows), ...Object.values(this.#labels), this.#handle.element);
    // Hidden until it has a position.
    setAttributes(this.#handle.element, { visibility: "hidden" });
    this.lay({
      title: bias.title,
      picture: element,
      controls: [
        ...this.knobs(["raise", "reach", "keep"], bias.knobs, BIAS_RANGES, { reach: "kappa", keep: "rho" }),
        this.guess("guess", bias.guess, { min: -180, max: 180 }, NO_GUESS, 1),
      ],
    });
  }

  protected async load(state: BiasState): Promise<Shown> {
    return { state, band: await biasOf(this.parts.engine, state) };
  }

  protected describe({ band, state }: Shown): string {
    const { x, mean, bias, y, deviation } = band;
    const reach = state.reach * deviation;
    const [at, from, to, out, back] = [x, mean - reach, mean + reach, bias, y].map((value) => this.number(value, 1));
    return this.words.bias.said(at!, from!, to!, out!, back!);
  }

  protected get columns() {
    return this.words.bias.columns;
  }

  protected rows({ band }: Shown): string[][] {
    const { rows } = this.words.bias;
    const names = Object.keys(rows) as (keyof typeof rows)[];
    return names.map((name) => [rows[name], this.number(band[name], 1)]);
  }

  protected override quantities({ band, state }: Shown) {
    const degrees = (value: number) => `${this.number(value, 1)}°`;
    return {
      x: degrees(band.x),
      mu: degrees(band.mean),
      sigma: `${this.number(band.deviation, 2)}°`,
      kappa: this.number(state.reach, 1),
      dx: degrees(band.bias),
      rho: this.number(state.keep, 2),
      beta: degrees(band.line),
      y: degrees(band.y),
    };
  }

  protected draw({ band, state }: Shown, { raise }: BiasState): void {
    const { x, mean, deviation, bias, line, y } = band;
    const reach = state.reach * deviation;
    const axes = this.plot(
      roundedExtent([...ENDS, mean - reach, mean + reach, x, line, y], 1),
      { min: 0, max: 1 },
      { x: this.words.bias.axis(this.words.joints[BIAS_JOINT]), y: "", columns: 7, digits: 0, unit: "°", rows: 0 },
    );
    const [above, below] = [axes.y(ROW.input), axes.y(ROW.output)];
    const at = (value: number) => axes.x(value);
    const edge = x - bias;
    setAttributes(this.#band, {
      x: at(mean - reach),
      y: above - HALF.band,
      width: Math.max(1, at(mean + reach) - at(mean - reach)),
      height: 2 * HALF.band,
    });
    setAttributes(this.#mean, { d: `M${at(mean)} ${above - HALF.band}v${2 * HALF.band}` });
    this.#drawDots(axes, band.examples, above);
    setAttributes(this.#bias, { d: arrow(at(edge), at(x), above) });
    setAttributes(this.#returned, { d: arrow(at(line), at(y), below) });
    setAttributes(this.#line, { cx: at(line), cy: below });
    setAttributes(this.#output, { d: `M${at(y)} ${below - HALF.tick}v${2 * HALF.tick}` });
    setAttributes(this.#rows.input, { x: axes.width - 16, y: above + 4, "text-anchor": "end" });
    setAttributes(this.#rows.output, { x: axes.width - 16, y: below + 4, "text-anchor": "end" });
    setText(this.#rows.input, this.words.bias.input);
    setText(this.#rows.output, this.words.bias.output);
    const degrees = (value: number) => `${this.number(value, 1)}°`;
    setAttributes(this.#labels.x, { x: at(x) + 8, y: above - HALF.tick - 4 });
    setText(this.#labels.x, `x ${degrees(x)}`);
    setAttributes(this.#labels.y, { x: at(y) + 8, y: below - HALF.tick });
    setText(this.#labels.y, `y ${degrees(y)}`);
    setAttributes(this.#handle.element, { visibility: "visible" });
    this.#handle.place({
      x: at(x + raise - state.raise),
      bottom: above + HALF.band,
      value: state.raise,
      text: `${state.raise}°`,
    });
    setText(this.readout, this.words.bias.read(this.number(mean - reach, 1), this.number(mean + reach, 1)));
  }

  #drawDots(axes: Axes, examples: readonly number[], height: number): void {
    keepCount(this.#dots, examples.length, () => svg("circle", { r: 2.5 }));
    examples.forEach((value, i) => {
      setAttributes(this.#dots.children[i]!, { cx: axes.x(value).toFixed(1), cy: height + HALF.tick });
    });
  }
}

/** An arrow between two positions of a row; empty if they are equal. */
function arrow(from: number, to: number, height: number): string {
  if (Math.abs(to - from) < 1) return "";
  const back = -Math.sign(to - from) * Math.min(HEAD, Math.abs(to - from));
  return `M${from} ${height}H${to}m${back} ${-HEAD / 1.6}L${to} ${height}l${back} ${HEAD / 1.6}`;
}
