/** The nearest classes at a frame: their distances, and the curve that converts them to weights. */
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
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
  measure: measureMix,
  sheet,
  create: (parts) => new BarsFigure(parts),
};

class BarsFigure extends PlotFigure<MixState, ClassShare[]> {
  readonly #rows = html("div", { class: "rows" });
  readonly #least = svg("path", { class: "guide", "data-term": "min" });
  readonly #decay = svg("path", { class: "decay", "data-term": "delta" });
  readonly #span = svg("path", { class: "span", "data-term": "delta" });
  readonly #feet = svg("g", { class: "feet", "data-term": "D" });
  readonly #dots = svg("g", { class: "dots", "data-term": "lambda" });
  readonly #labels = {
    least: svg("text", { class: "label", "data-term": "min" }),
    span: svg("text", { class: "label", "data-term": "delta" }),
  };

  constructor(parts: FigureParts<MixState>) {
    const { mix } = parts.words;
    super(parts, mix.decay);
    const { least, span } = this.#labels;
    const columns = mix.columns.map((name) => html("span", {}, name));
    const list = html("div", { class: "bars" }, html("div", { class: "class columns" }, ...columns), this.#rows);
    this.frame.picture.append(this.#least, this.#span, this.#decay, this.#feet, this.#dots, least, span);
    this.lay({
      title: mix.title,
      picture: html(
        "div",
        { class: "beside", role: "group", "aria-label": mix.title, tabindex: 0 },
        html("div", { class: "picture listed" }, list),
        this.frame.element,
      ),
      foot: [],
      controls: [this.guess("guess", mix.guess, { min: 0, max: 1 }, -1, 3)],
    });
  }

  protected load(state: MixState): Promise<ClassShare[]> {
    return sharesOf(this.parts.engine, state);
  }

  protected describe(shares: ClassShare[]): string {
    const said = shares.slice(0, 3).map((one) => this.words.mix.class(...this.#said(one)));
    return said.length > 0 ? this.words.mix.nearest(said.join("; ")) : "";
  }

  protected get columns() {
    return this.words.mix.columns;
  }

  protected rows(shares: ClassShare[]): string[][] {
    return shares.slice(0, SHOWN).map((one) => this.#said(one));
  }

  protected override quantities([first, second]: ClassShare[], { delta }: MixState): Readonly<Record<string, string>> {
    if (!first || !second) return {};
    const here = widthAt(first.square, delta);
    const said = this.number(delta, 2);
    return {
      D: `${this.number(second.square, 2)} cm²`,
      min: `${this.number(first.square, 2)} cm²`,
      lambda: this.number(second.weight, 2),
      delta: here > (1 + WIDER) * delta ? this.words.mix.here(said, this.number(here, 2)) : said,
    };
  }

  #said({ action, style, square, weight }: ClassShare): [name: string, square: string, weight: string] {
    const styles: Readonly<Record<string, string>> = this.words.styles;
    const name = `${this.words.mix.actions[action] ?? action} / ${styles[style] ?? style}`;
    return [name, this.number(square, 2), this.number(weight, 2)];
  }

  protected override redraw(): void {
    const shown = (this.shown ?? []).slice(0, SHOWN);
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
    super.redraw();
  }

  /** λ over D: it begins at the nearest class, and passes through every class. */
  protected draw(shares: ClassShare[], state: MixState): void {
    const shown = shares.slice(0, SHOWN);
    const [first] = shown;
    if (!first) return;
    const { max } = roundedExtent([0, ...shown.map(({ square }) => square)], 1);
    const labels = { x: this.words.mix.distance, y: this.words.mix.weight, columns: 5, rows: 2 };
    const axes = this.plot({ min: 0, max }, { min: 0, max: 1 }, labels);
    const least = Math.max(FLOOR, first.square);
    const span = widthAt(first.square, state.delta) * least;
    const curve = Array.from({ length: PIECES + 1 }, (_, i) => {
      const square = first.square + ((max - first.square) * i) / PIECES;
      const weight = first.weight * Math.exp((first.square - square) / span);
      return axes.at(square, weight);
    });
    setAttributes(this.#decay, { d: `M${curve.join("L")}` });
    const [start, bottom] = [axes.x(first.square), axes.y(0)];
    setAttributes(this.#least, { d: `M${start} ${bottom}V${axes.y(1)}` });
    setAttributes(this.#labels.least, { x: start + 5, y: axes.y(1) + 12 });
    setText(this.#labels.least, this.words.mix.least);
    // The distance over which a weight falls to 1/e.
    const [height, end] = [axes.y(first.weight / Math.E), Math.min(max, first.square + span)];
    setAttributes(this.#span, { d: `M${start} ${height - 4}v8M${start} ${height}H${axes.x(end)}` });
    // Near the right edge its label is above the dots.
    const isWide = end > SPAN_BESIDE * max;
    const place = isWide
      ? { x: axes.x(end) - 4, "text-anchor": "end" }
      : { x: axes.x(end) + 6, "text-anchor": "start" };
    setAttributes(this.#labels.span, { ...place, y: Math.min(height, bottom - 24) - (isWide ? 18 : 6) });
    setText(this.#labels.span, this.words.mix.span);
    for (const [group, tag] of [
      [this.#dots, "circle"],
      [this.#feet, "path"],
    ] as const)
      keepCount(group, shown.length, () => svg(tag, {}));
    shown.forEach(({ square, weight }, i) => {
      const [x, y] = [axes.x(square).toFixed(1), axes.y(weight).toFixed(1)];
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
