/** The contribution of each term of the line to one prediction: bars that begin where the previous one ended. */
import type { Fit } from "../../client/learn/protocol";
import { DEGREES } from "../../humanoid";
import { keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import { MARGIN } from "../axes";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
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
  measure: measureLine,
  sheet,
  create: (parts) => new TermsFigure(parts),
};

class TermsFigure extends PlotFigure<LineState, Row[]> {
  readonly #zero = svg("path", { class: "zero" });
  readonly #rows = svg("g", { class: "terms" });

  constructor(parts: FigureParts<LineState>) {
    const { terms } = parts.words.line;
    super(parts, terms);
    this.frame.picture.append(this.#zero, this.#rows);
    this.lay({ title: terms, picture: this.frame.element });
  }

  protected async load(state: LineState): Promise<Row[]> {
    return rowsOf(await fitOf(this.parts.engine, state));
  }

  protected describe(rows: Row[]): string {
    const { line } = this.words;
    const said = rows.slice(0, -1).map((row) => `${line.termNames[row.term]} ${this.#degrees(row.to - row.from)}`);
    return line.summed(said.join(", "), this.#degrees(rows.at(-1)!.to));
  }

  protected get columns() {
    return this.words.line.termColumns;
  }

  protected rows(rows: Row[]): string[][] {
    return rows.map((row) => [
      this.words.line.termNames[row.term],
      row.coefficient === undefined ? "–" : this.number(row.coefficient, 2),
      this.number(row.to - row.from, 1),
    ]);
  }

  #degrees(value: number): string {
    return `${this.number(value, 1)}°`;
  }

  protected draw(rows: Row[]): void {
    const axes = this.plot(
      roundedExtent([0, ...rows.flatMap(({ from, to }) => [from, to])], 1),
      { min: 0, max: rows.length },
      { x: this.words.line.adds, y: "", columns: 6, unit: "°", rows: 0 },
      { margin: ROOM },
    );
    const bottom = axes.height - ROOM.bottom;
    const step = (bottom - ROOM.top) / rows.length;
    const height = Math.min(BAR.most, BAR.share * step);
    setAttributes(this.#zero, { d: `M${axes.x(0)} ${ROOM.top}V${bottom}` });
    keepCount(this.#rows, rows.length, () => this.#row());
    rows.forEach(({ term, from, to }, i) => {
      const element = this.#rows.children[i]!;
      const middle = ROOM.top + (i + 0.5) * step;
      const [left, right] = [Math.min(from, to), Math.max(from, to)].map((value) => axes.x(value)) as [number, number];
      setAttributes(element, { class: term === "y" ? "term sum" : "term", "data-term": term });
      const [hit, bar, link, name, value] = element.children as unknown as SVGElement[];
      setAttributes(hit!, { x: 0, y: middle - step / 2, width: axes.width, height: step });
      setAttributes(bar!, { x: left, y: middle - height / 2, width: Math.max(1.5, right - left), height });
      // From the end of a bar to the start of the next.
      const end = i < rows.length - 1 ? `M${axes.x(to)} ${middle + height / 2}V${middle + step - height / 2}` : "";
      setAttributes(link!, { d: end });
      setAttributes(name!, { x: 20, y: middle + 4 });
      setText(name!, this.words.line.termNames[term]);
      setAttributes(value!, { x: axes.width - ROOM.right + 8, y: middle + 4 });
      const sign = term === "y" || to < from ? "" : "+";
      setText(value!, `${sign}${this.#degrees(term === "y" ? to : to - from)}`);
    });
    const [, a, b, c] = rows;
    const two = (row: Row | undefined) => this.number(row?.coefficient ?? Number.NaN, 2);
    setText(this.readout, `a ${two(a)} · b ${two(b)} · c ${two(c)}`);
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
    row.addEventListener("pointerenter", () => this.parts.point(row.getAttribute("data-term") ?? undefined));
    row.addEventListener("pointerleave", () => this.parts.point(undefined));
    return row;
  }
}

/** The terms of the prediction, and their sum. */
function rowsOf(fit: Fit): Row[] {
  const { beta, predicted } = fit;
  const terms = termsOf(fit);
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
