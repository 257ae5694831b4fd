/** The contribution of each term of the line to one prediction: bars that begin where the previous one ended. */
import type { Fit } from "../../client/learn/protocol";
import { DEGREES } from "../../humanoid";
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, digitsOf, extentOf, MARGIN, ticksOf, xOf } from "../axes";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./line.css?inline";
import { fitOf, measureLine, termsOf } from "./line_measure";
import { LINE_FIELDS, type LineState } from "./line_state";

/** Share of a row that its bar fills, and its largest height, pixels. */
const BAR = { share: 0.6, most: 28 };
/** Space for the names of the rows, and for the values at the other side, pixels. */
const ROOM = { ...MARGIN, left: 84, right: 64 };
/** A returned part below this is not shown, degrees. */
const NOTHING = 0.05;

/** A row: its term, its coefficient, and the ends of its bar, degrees. */
interface Row {
  term: "a" | "b" | "c" | "d" | "returned" | "y";
  coefficient: number | undefined;
  from: number;
  to: number;
}

export const TERMS: FigureKind<LineState> = {
  fields: LINE_FIELDS,
  sheet,
  create: (parts) => new TermsFigure(parts),
};

class TermsFigure implements FigureInstance<LineState> {
  readonly #parts: FigureParts<LineState>;
  readonly #frame: PlotFrame;
  readonly #zero = svg("path", { class: "zero" });
  readonly #rows = svg("g", { class: "terms" });
  readonly #readout = html("p", { class: "readout" });
  readonly #fitting = new Latest<LineState>((state) => this.#fit(state));
  #state: LineState | undefined;
  #fitted: Fit | undefined;

  constructor(parts: FigureParts<LineState>) {
    this.#parts = parts;
    const { words, container, signal } = parts;
    this.#frame = new PlotFrame(words.line.terms, () => this.#drawNow(), signal);
    this.#frame.picture.append(this.#zero, this.#rows);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.line.terms)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: LineState): Promise<void> {
    this.#state = state;
    return this.#fitting.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureLine(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const rows = this.#list();
    if (rows.length === 0) return "";
    const { words } = this.#parts;
    const said = rows
      .slice(0, -1)
      .map((row) => `${words.line.termNames[row.term]} ${this.#degrees(row.to - row.from)}`);
    return words.line.summed(said.join(", "), this.#degrees(rows.at(-1)!.to));
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = this.#list().map((row) => [
      words.line.termNames[row.term],
      row.coefficient === undefined ? "–" : figure(row.coefficient, 2, words),
      figure(row.to - row.from, 1, words),
    ]);
    return { head: words.line.termColumns, rows };
  }

  values(): Readonly<Record<string, string>> {
    return {};
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  #degrees(value: number): string {
    return `${figure(value, 1, this.#parts.words)}°`;
  }

  /** The terms of the prediction, and their sum. */
  #list(): Row[] {
    if (!this.#fitted) return [];
    const { beta, predicted } = this.#fitted;
    const terms = termsOf(this.#fitted);
    const rows: Row[] = [];
    let from = 0;
    const add = (term: Exclude<Row["term"], "y">, coefficient?: number) => {
      rows.push({ term, coefficient, from, to: from + terms[term] });
      from += terms[term];
    };
    // The constant is by far the largest: when it comes first, the others stay within the picture.
    add("d");
    add("a", beta[0]);
    add("b", beta[1]);
    add("c", beta[2]);
    if (Math.abs(terms.returned) >= NOTHING) add("returned");
    rows.push({ term: "y", coefficient: undefined, from: 0, to: predicted * DEGREES });
    return rows;
  }

  async #fit(state: LineState): Promise<void> {
    const fit = await fitOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#fitted = fit;
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const rows = this.#list();
    if (rows.length === 0) return;
    const { words } = this.#parts;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: extentOf([0, ...rows.flatMap(({ from, to }) => [from, to])], 1),
      y: [0, rows.length],
      margin: ROOM,
    };
    const ticks = ticksOf(axes.x, 6);
    const columns = ticks.map((value) => [value, `${figure(value, digitsOf(ticks), words)}°`] as const);
    this.#frame.drawGrid(axes, { x: words.line.adds, y: "", columns, rows: [] }, words);
    const bottom = axes.height - ROOM.bottom;
    const step = (bottom - ROOM.top) / rows.length;
    const height = Math.min(BAR.most, BAR.share * step);
    setAttributes(this.#zero, { d: `M${xOf(axes, 0)} ${ROOM.top}V${bottom}` });
    keepCount(this.#rows, rows.length, () => this.#row());
    rows.forEach(({ term, from, to }, i) => {
      const element = this.#rows.children[i]!;
      const middle = ROOM.top + (i + 0.5) * step;
      const [left, right] = [Math.min(from, to), Math.max(from, to)].map((value) => xOf(axes, value)) as [
        number,
        number,
      ];
      setAttributes(element, { class: term === "y" ? "term sum" : "term", "data-term": term });
      const [hit, bar, link, name, value] = element.children as unknown as SVGElement[];
      setAttributes(hit!, { x: 0, y: middle - step / 2, width: axes.width, height: step });
      setAttributes(bar!, { x: left, y: middle - height / 2, width: Math.max(1.5, right - left), height });
      // From the end of a bar to the start of the next.
      const end = i < rows.length - 1 ? `M${xOf(axes, to)} ${middle + height / 2}V${middle + step - height / 2}` : "";
      setAttributes(link!, { d: end });
      setAttributes(name!, { x: 20, y: middle + 4 });
      setText(name!, words.line.termNames[term]);
      setAttributes(value!, { x: axes.width - ROOM.right + 8, y: middle + 4 });
      const sign = term === "y" || to < from ? "" : "+";
      setText(value!, `${sign}${this.#degrees(term === "y" ? to : to - from)}`);
    });
    const [, a, b, c] = rows;
    const two = (row: Row | undefined) => figure(row?.coefficient ?? Number.NaN, 2, words);
    setText(this.#readout, `a ${two(a)} · b ${two(b)} · c ${two(c)}`);
  }

  #row(): SVGElement {
    const row = svg(
      "g",
      { class: "term" },
      svg("rect", { class: "hit" }),
      svg("rect", { class: "bar" }),
      svg("path", { class: "link" }),
      svg("text", { class: "name" }),
      svg("text", { class: "value" }),
    );
    // Rows are reused: each reports its current term.
    row.addEventListener("pointerenter", () => this.#parts.point(row.getAttribute("data-term") ?? undefined));
    row.addEventListener("pointerleave", () => this.#parts.point(undefined));
    return row;
  }
}
