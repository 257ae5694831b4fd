/** The nearest classes at a frame: their distances, and the curve that converts them to weights. */
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, digitsOf, extentOf, ticksOf, xOf, yOf } from "../axes";
import { GuessField } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./mix.css?inline";
import { type ClassShare, FLOOR, measureMix, sharesOf, widthAt } from "./mix_measure";
import { MIX_FIELDS, type MixState } from "./mix_state";

/** Number of displayed classes. */
const SHOWN = 6;
/** Number of classes in the question. */
const ASKED = 2;
/** Up to this share of the axis the width is labelled next to its line. */
const SPAN_BESIDE = 0.7;
/** Number of segments of the curve. */
const PIECES = 48;
/** The actual δ is displayed if it differs by more than this share. */
const WIDER = 0.01;

export const BARS: FigureKind<MixState> = {
  fields: MIX_FIELDS,
  sheet,
  create: (parts) => new BarsFigure(parts),
};

class BarsFigure implements FigureInstance<MixState> {
  readonly #parts: FigureParts<MixState>;
  readonly #rows = html("div", { class: "rows" });
  readonly #frame: PlotFrame;
  readonly #least = svg("path", { class: "guide", "data-term": "min" });
  readonly #decay = svg("path", { class: "decay", "data-term": "delta" });
  readonly #span = svg("path", { class: "span", "data-term": "delta" });
  readonly #feet = svg("g", { class: "feet", "data-term": "D" });
  readonly #dots = svg("g", { class: "dots", "data-term": "lambda" });
  readonly #labels = {
    least: svg("text", { class: "label", "data-term": "min" }),
    span: svg("text", { class: "label", "data-term": "delta" }),
  };
  readonly #guess: GuessField;
  readonly #sharing = new Latest<MixState>((state) => this.#share(state));
  #state: MixState | undefined;
  #shares: ClassShare[] = [];

  constructor(parts: FigureParts<MixState>) {
    this.#parts = parts;
    const { words, container, change, signal } = parts;
    this.#guess = new GuessField(words.mix.guess, { min: 0, max: 1 }, -1, (guess) => change({ guess }, true), signal);
    this.#frame = new PlotFrame(words.mix.decay, () => this.#drawNow(), signal);
    const { least, span } = this.#labels;
    const columns = words.mix.columns.map((name) => html("span", {}, name));
    const list = html("div", { class: "bars" }, html("div", { class: "class columns" }, ...columns), this.#rows);
    this.#frame.picture.append(this.#least, this.#span, this.#decay, this.#feet, this.#dots, least, span);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.mix.title)),
      html(
        "div",
        { class: "beside", role: "group", "aria-label": words.mix.title, tabindex: 0 },
        html("div", { class: "picture listed" }, list),
        this.#frame.element,
      ),
      html("div", { class: "knobs" }, this.#guess.element),
    );
  }

  show(state: MixState): Promise<void> {
    this.#state = state;
    this.#guess.text = state.guess < 0 ? "" : figure(state.guess, 3, this.#parts.words);
    return this.#sharing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMix(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const { words } = this.#parts;
    const shown = this.#shares.slice(0, 3).map((one) => words.mix.class(...this.#said(one)));
    return shown.length > 0 ? words.mix.nearest(shown.join("; ")) : "";
  }

  table(): Table {
    return {
      head: this.#parts.words.mix.columns,
      rows: this.#shares.slice(0, SHOWN).map((one) => [...this.#said(one)]),
    };
  }

  values(): Readonly<Record<string, string>> {
    const { words } = this.#parts;
    const [first, second] = this.#shares;
    const delta = this.#state?.delta;
    if (!first || !second || delta === undefined) return {};
    const here = widthAt(first.square, delta);
    const said = figure(delta, 2, words);
    return {
      D: `${figure(second.square, 2, words)} cm²`,
      min: `${figure(first.square, 2, words)} cm²`,
      lambda: figure(second.weight, 2, words),
      delta: here > (1 + WIDER) * delta ? words.mix.here(said, figure(here, 2, words)) : said,
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    for (const mark of this.#rows.querySelectorAll("[data-term]"))
      mark.classList.toggle("lit", mark.getAttribute("data-term") === term);
  }

  #said({ action, style, square, weight }: ClassShare): [name: string, square: string, weight: string] {
    const { words } = this.#parts;
    const styles: Readonly<Record<string, string>> = words.styles;
    const name = `${words.mix.actions[action] ?? action} / ${styles[style] ?? style}`;
    return [name, figure(square, 2, words), figure(weight, 2, words)];
  }

  async #share(state: MixState): Promise<void> {
    const shares = await sharesOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#shares = shares;
    this.#draw();
    this.#parts.changed();
  }

  #draw(): void {
    const shown = this.#shares.slice(0, SHOWN);
    const greatest = Math.max(...shown.map(({ square }) => square));
    keepCount(this.#rows, shown.length, () => row());
    shown.forEach((one, i) => {
      const element = this.#rows.children[i]!;
      const [name, square, weight] = this.#said(one);
      element.classList.toggle("asked", i < ASKED);
      element.querySelector(".least")!.toggleAttribute("hidden", i > 0);
      setText(element.querySelector(".name")!, name);
      setText(element.querySelector(".square .number")!, `${square} cm²`);
      setText(element.querySelector(".weight .number")!, weight);
      element.querySelector<HTMLElement>(".square .bar")!.style.setProperty("--share", String(one.square / greatest));
      element.querySelector<HTMLElement>(".weight .bar")!.style.setProperty("--share", String(one.weight));
    });
    this.#frame.request();
  }

  /** λ over D: it begins at the nearest class, and passes through every class. */
  #drawNow(): void {
    const [shown, state] = [this.#shares.slice(0, SHOWN), this.#state];
    const [first] = shown;
    if (!first || !state) return;
    const { words } = this.#parts;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, extentOf([0, ...shown.map(({ square }) => square)], 1)[1]],
      y: [0, 1],
    };
    const ticks = ticksOf(axes.x, 5);
    const columns = ticks.map((value) => [value, figure(value, digitsOf(ticks), words)] as const);
    this.#frame.drawGrid(axes, { x: words.mix.distance, y: words.mix.weight, columns, rows: [0, 0.5, 1] }, words);
    const least = Math.max(FLOOR, first.square);
    const span = widthAt(first.square, state.delta) * least;
    const curve = Array.from({ length: PIECES + 1 }, (_, i) => {
      const square = first.square + ((axes.x[1] - first.square) * i) / PIECES;
      const weight = first.weight * Math.exp((first.square - square) / span);
      return `${xOf(axes, square).toFixed(1)} ${yOf(axes, weight).toFixed(1)}`;
    });
    setAttributes(this.#decay, { d: `M${curve.join("L")}` });
    const [start, bottom] = [xOf(axes, first.square), yOf(axes, 0)];
    setAttributes(this.#least, { d: `M${start} ${bottom}V${yOf(axes, 1)}` });
    setAttributes(this.#labels.least, { x: start + 5, y: yOf(axes, 1) + 12 });
    setText(this.#labels.least, words.mix.least);
    // The distance over which a weight falls to 1/e.
    const [height, end] = [yOf(axes, first.weight / Math.E), Math.min(axes.x[1], first.square + span)];
    setAttributes(this.#span, { d: `M${start} ${height - 4}v8M${start} ${height}H${xOf(axes, end)}` });
    // Near the right edge its label is above the dots.
    const isWide = end > SPAN_BESIDE * axes.x[1];
    const place = isWide
      ? { x: xOf(axes, end) - 4, "text-anchor": "end" }
      : { x: xOf(axes, end) + 6, "text-anchor": "start" };
    setAttributes(this.#labels.span, { ...place, y: Math.min(height, bottom - 24) - (isWide ? 18 : 6) });
    setText(this.#labels.span, words.mix.span);
    for (const [group, tag] of [
      [this.#dots, "circle"],
      [this.#feet, "path"],
    ] as const)
      keepCount(group, shown.length, () => svg(tag, {}));
    shown.forEach(({ square, weight }, i) => {
      const [x, y] = [xOf(axes, square).toFixed(1), yOf(axes, weight).toFixed(1)];
      setAttributes(this.#dots.children[i]!, { cx: x, cy: y, r: 4 });
      setAttributes(this.#feet.children[i]!, { d: `M${x} ${bottom + 3}V${y}` });
    });
  }
}

function row(): HTMLElement {
  const bar = (kind: string, term: string) =>
    html("span", { class: kind, "data-term": term }, html("i", { class: "bar" }), html("span", { class: "number" }));
  const square = bar("square", "D");
  // The first one has the smallest distance.
  square.append(html("span", { class: "least", "data-term": "min" }, "min"));
  return html("div", { class: "class" }, html("span", { class: "name" }), square, bar("weight", "lambda"));
}
