/** One degree of freedom on an axis: the band of the neighbours, the part of the input outside it, and the returned part. */
import type { Knob } from "../../ui/controls/knob";
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, extentOf, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { createKnobs, GuessField } from "../controls";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
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

const KNOBS = ["raise", "reach", "keep"] as const;
type KnobName = (typeof KNOBS)[number];

export const BAND: FigureKind<BiasState> = {
  fields: BIAS_FIELDS,
  sheet,
  create: (parts) => new BandFigure(parts),
};

class BandFigure implements FigureInstance<BiasState> {
  readonly #parts: FigureParts<BiasState>;
  readonly #frame: PlotFrame;
  readonly #knobs: Record<KnobName, Knob>;
  readonly #guess: GuessField;
  readonly #handle: Handle;
  readonly #readout = html("p", { class: "readout" });
  readonly #band = svg("rect", { class: "band", "data-term": "kappa" });
  readonly #mean = svg("path", { class: "mean", "data-term": "mu" });
  readonly #dots = svg("g", { class: "dots", "data-term": "sigma" });
  readonly #bias = svg("path", { class: "arrow bias", "data-term": "dx" });
  readonly #line = svg("circle", { class: "query", r: 4, "data-term": "beta" });
  readonly #returned = svg("path", { class: "arrow returned", "data-term": "rho" });
  readonly #output = svg("path", { class: "output", "data-term": "y" });
  readonly #labels = { x: svg("text", { class: "label x" }), y: svg("text", { class: "label y" }) };
  readonly #rows = { input: svg("text", { class: "label row" }), output: svg("text", { class: "label row" }) };
  readonly #fitting = new Latest<BiasState>((state) => this.#fit(state));
  #state: BiasState | undefined;
  #fitted: { state: BiasState; band: Band } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<BiasState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.bias.title, () => this.#drawNow(), signal);
    const settle = () => change({}, true);
    this.#knobs = createKnobs(KNOBS, words, words.bias.knobs, BIAS_RANGES, BIAS_FIELDS, change);
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.bias.knobs.raise.name,
      "x",
      picture,
      {
        value: () => this.#fitted && this.#state?.raise,
        // The input's angle increases with the raise, degree by degree.
        valueOf: (x) => this.#fitted!.state.raise + valueOfX(this.#axes!, x) - this.#fitted!.band.x,
        stepped: (raise, direction, fine) => raise + direction * (fine ? 1 : STEP),
        ends: () => [BIAS_RANGES.raise.min, BIAS_RANGES.raise.max],
        onInput: (raise) => change({ raise: Math.round(raise) }, false),
        onSettle: settle,
      },
      signal,
    );
    this.#guess = new GuessField(
      words.bias.guess,
      { min: -180, max: 180 },
      NO_GUESS,
      (guess) => change({ guess }, true),
      signal,
    );
    picture.append(this.#band, this.#mean, this.#dots, this.#bias, this.#returned, this.#line, this.#output);
    picture.append(...Object.values(this.#rows), ...Object.values(this.#labels), this.#handle.element);
    // Hidden until it has a position.
    setAttributes(this.#handle.element, { visibility: "hidden" });
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.bias.title)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs" }, ...KNOBS.map((name) => this.#knobs[name].element), this.#guess.element),
    );
  }

  show(state: BiasState): Promise<void> {
    this.#state = state;
    for (const name of KNOBS) this.#knobs[name].value = state[name];
    this.#guess.text = state.guess === NO_GUESS ? "" : figure(state.guess, 1, this.#parts.words);
    this.#frame.request();
    return this.#fitting.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureBias(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#fitted) return "";
    const { band, state } = this.#fitted;
    const reach = state.reach * band.deviation;
    const degrees = (value: number) => figure(value, 1, this.#parts.words);
    const { x, mean, bias, y } = band;
    return this.#parts.words.bias.said(
      degrees(x),
      degrees(mean - reach),
      degrees(mean + reach),
      degrees(bias),
      degrees(y),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const { columns, rows } = words.bias;
    const band = this.#fitted?.band;
    const names = Object.keys(rows) as (keyof typeof rows)[];
    return {
      head: columns,
      rows: band ? names.map((name) => [rows[name], figure(band[name], 1, words)]) : [],
    };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#fitted) return {};
    const { band, state } = this.#fitted;
    const { words } = this.#parts;
    const degrees = (value: number) => `${figure(value, 1, words)}°`;
    return {
      x: degrees(band.x),
      mu: degrees(band.mean),
      sigma: `${figure(band.deviation, 2, words)}°`,
      kappa: figure(state.reach, 1, words),
      dx: degrees(band.bias),
      rho: figure(state.keep, 2, words),
      beta: degrees(band.line),
      y: degrees(band.y),
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    this.#knobs.reach.element.classList.toggle("lit", term === "kappa");
    this.#knobs.keep.element.classList.toggle("lit", term === "rho");
  }

  async #fit(state: BiasState): Promise<void> {
    const band = await biasOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#fitted = { state, band };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#fitted) return;
    const { words } = this.#parts;
    const { band, state } = this.#fitted;
    const { x, mean, deviation, bias, line, y } = band;
    const reach = state.reach * deviation;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: extentOf([...ENDS, mean - reach, mean + reach, x, line, y], 1),
      y: [0, 1],
    };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 7).map((value) => [value, `${figure(value, 0, words)}°`] as const);
    const name = words.bias.axis(words.joints[BIAS_JOINT]);
    this.#frame.drawGrid(axes, { x: name, y: "", columns, rows: [] }, words);
    const [above, below] = [yOf(axes, ROW.input), yOf(axes, ROW.output)];
    const at = (value: number) => xOf(axes, value);
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
    setText(this.#rows.input, words.bias.input);
    setText(this.#rows.output, words.bias.output);
    const degrees = (value: number) => `${figure(value, 1, words)}°`;
    setAttributes(this.#labels.x, { x: at(x) + 8, y: above - HALF.tick - 4 });
    setText(this.#labels.x, `x ${degrees(x)}`);
    setAttributes(this.#labels.y, { x: at(y) + 8, y: below - HALF.tick });
    setText(this.#labels.y, `y ${degrees(y)}`);
    setAttributes(this.#handle.element, { visibility: "visible" });
    // The handle follows the pointer at once; everything else waits for the engine.
    const ahead = (this.#state?.raise ?? state.raise) - state.raise;
    this.#handle.place({ x: at(x + ahead), bottom: above + HALF.band, value: state.raise, text: `${state.raise}°` });
    setText(this.#readout, words.bias.read(figure(mean - reach, 1, words), figure(mean + reach, 1, words)));
  }

  #drawDots(axes: Axes, examples: readonly number[], height: number): void {
    keepCount(this.#dots, examples.length, () => svg("circle", { r: 2.5 }));
    examples.forEach((value, i) => {
      setAttributes(this.#dots.children[i]!, { cx: xOf(axes, value).toFixed(1), cy: height + HALF.tick });
    });
  }
}

/** An arrow between two positions of a row; empty if they are equal. */
function arrow(from: number, to: number, height: number): string {
  if (Math.abs(to - from) < 1) return "";
  const back = -Math.sign(to - from) * Math.min(HEAD, Math.abs(to - from));
  return `M${from} ${height}H${to}m${back} ${-HEAD / 1.6}L${to} ${height}l${back} ${HEAD / 1.6}`;
}
