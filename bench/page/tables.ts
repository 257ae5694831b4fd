/** A report as tables of the page. */
import { html } from "../../web/ui/dom";
import { ENGINES, type EngineName, MODES, medianOf, type Report, speedUp } from "../report";
import { milliseconds, PAPER_MS } from "../table";

const MODE_NAMES = { labelled: "Labelled", unlabelled: "Unlabelled", all: "All classes" } as const;
const ENGINE_NAMES: Readonly<Record<EngineName, string>> = {
  "wasm-simd": "Strut",
  "wasm-scalar": "Strut without SIMD",
  "wasm-naive": "Plain Rust",
  "js-naive": "Plain JavaScript",
};

/** Longer names of stages for the page. */
const STAGE_NAMES: Readonly<Record<string, string>> = { open: "Opening", frame: "Whole frame" };
const stageName = (stage: string) => STAGE_NAMES[stage] ?? `${stage[0]!.toUpperCase()}${stage.slice(1)}`;

type Cell = Node | string;

/** Returns a table with a heading. @param total first cell of the emphasised line */
export function table(caption: string, heading: string[], lines: Cell[][], total?: string): HTMLElement[] {
  const row = (cells: Cell[]) =>
    html(
      "tr",
      { class: cells[0] === total ? "total" : "" },
      ...cells.map((cell, i) => html(i === 0 ? "th" : "td", i === 0 ? { scope: "row" } : {}, cell)),
    );
  const head = html("tr", {}, ...heading.map((name) => html("th", { scope: "col" }, name)));
  return [
    html("h2", {}, caption),
    html(
      "div",
      { class: "scroller" },
      html("table", {}, html("thead", {}, head), html("tbody", {}, ...lines.map(row))),
    ),
  ];
}

/** Returns all results, with headings. */
export function tables(report: Report): HTMLElement[] {
  const modes = MODES.map((mode) => MODE_NAMES[mode]);
  const ours = report.rows.filter((row) => row.engine === "wasm-simd");
  const cell = (stage: string, mode: string): Cell => {
    const row = ours.find((r) => r.stage === stage && r.mode === mode);
    if (!row) return "";
    const tail = html("span", { class: "tail" }, milliseconds(row.p95_ms));
    return html("span", {}, milliseconds(row.median_ms), " ", tail);
  };
  const stages = [...new Set(ours.map((row) => row.stage))];
  return [
    ...table(
      "Strut, milliseconds per frame: median and 95th percentile",
      ["Stage", ...modes, "Paper"],
      stages.map((stage) => [
        stageName(stage),
        ...MODES.map((mode) => cell(stage, mode)),
        String(PAPER_MS[stage] ?? ""),
      ]),
      stageName("frame"),
    ),
    ...table(
      "Whole frame, milliseconds, and how many times faster Strut is",
      ["Engine", ...modes],
      ENGINES.map((engine) => [
        ENGINE_NAMES[engine],
        ...MODES.map((mode) => {
          const ratio = engine === "wasm-simd" ? "" : `${speedUp(report, engine, mode).toFixed(1)} ×`;
          return html(
            "span",
            {},
            milliseconds(medianOf(report, engine, mode, "frame")!),
            " ",
            html("span", { class: "tail" }, ratio),
          );
        }),
      ]),
      ENGINE_NAMES["wasm-simd"],
    ),
    html(
      "p",
      { class: "caption" },
      "Strut's frame also includes features, blending and feet, which the plain loops omit.",
    ),
    ...table(
      "Neighbours that the plain loops and Strut both find",
      ["Engine", "Sets", "Identical", "Tied", "Furthest apart"],
      ENGINES.filter((engine) => report.agreement.some((a) => a.engine === engine)).map((engine) => {
        const of = report.agreement.filter((a) => a.engine === engine);
        const sum = (count: (a: (typeof of)[number]) => number) => of.reduce((total, a) => total + count(a), 0);
        const apart = Math.max(...of.map((a) => a.largest_difference));
        return [
          ENGINE_NAMES[engine],
          String(sum((a) => a.neighbour_sets)),
          String(sum((a) => a.identical)),
          String(sum((a) => a.tied)),
          `${((apart * 180) / Math.PI).toFixed(4)}°`,
        ];
      }),
    ),
  ];
}
