/** A report as readable tables. */
import type { Memory } from "./memory";
import { ENGINES, type EngineName, MODES, type Report, speedUp } from "./report";

/** Times of Table 2 of Xia et al. 2015, milliseconds, at 79,829 frames; the search ran on a GPU. */
export const PAPER_MS: Readonly<Record<string, number>> = {
  frame: 18.1,
  search: 7.31,
  regression: 9.7,
  footplant: 1.09,
};

/** A line of cells. */
export type Cells = string[];

/** Formats milliseconds with about three digits. */
export const milliseconds = (ms: number) => (ms >= 100 ? ms.toFixed(0) : ms >= 10 ? ms.toFixed(1) : ms.toFixed(3));

/**
 * Returns a table of stage × mode of one engine: a heading, then one line per stage with median and 95th percentile.
 */
export function stageTable(report: Report, engine: EngineName | "native"): Cells[] {
  const rows = report.rows.filter((row) => row.engine === engine);
  const stages = [...new Set(rows.map((row) => row.stage))];
  const cell = (stage: string, mode: string) => {
    const row = rows.find((r) => r.stage === stage && r.mode === mode);
    return row ? [milliseconds(row.median_ms), milliseconds(row.p95_ms)] : ["", ""];
  };
  return [
    ["stage", ...MODES.flatMap((mode) => [mode, "p95"]), "paper"],
    ...stages.map((stage) => [
      stage,
      ...MODES.flatMap((mode) => cell(stage, mode)),
      stage in PAPER_MS ? String(PAPER_MS[stage]) : "",
    ]),
  ];
}

/** Returns how many times faster the engine with SIMD is than each reference implementation. */
export function ratioTable(report: Report): Cells[] {
  const yardsticks = ENGINES.filter((engine) => engine !== "wasm-simd");
  const stages = ["frame", "search", "regression", "timing", "contact"];
  return [
    ["faster than", "stage", ...MODES],
    ...yardsticks.flatMap((engine) =>
      stages.map((stage) => [
        engine,
        stage,
        ...MODES.map((mode) => `${speedUp(report, engine, mode, stage).toFixed(1)} ×`),
      ]),
    ),
  ];
}

/** Returns the differences between the reference implementations' results and the engine's. */
export function agreementTable(report: Report): Cells[] {
  return [
    ["yardstick", "mode", "neighbour sets", "identical", "tied", "joint angle", "duration, ms", "contact"],
    ...report.agreement.map((a) => [
      a.engine,
      a.mode,
      String(a.neighbour_sets),
      String(a.identical),
      String(a.tied),
      a.largest_difference.toExponential(1),
      a.largest_duration_difference_ms.toExponential(1),
      a.largest_contact_difference.toExponential(1),
    ]),
  ];
}

/** Megabytes of WASM memory. */
export function memoryTable(memory: readonly Memory[]): Cells[] {
  return [
    ["memory, MB", "database open", "one style", "three styles", "and every class"],
    ...memory.map((m) => [
      m.engine,
      ...[m.open_mb, m.one_style_mb, m.three_styles_mb, m.every_class_mb].map((mb) => mb.toFixed(0)),
    ]),
  ];
}

/** Returns cells in columns, the first left-aligned, the others right-aligned. */
export function aligned(table: Cells[]): string {
  const widths = table[0]!.map((_, column) => Math.max(...table.map((line) => line[column]!.length)));
  const pad = (cell: string, column: number) =>
    column === 0 ? cell.padEnd(widths[0]!) : cell.padStart(widths[column]!);
  return table.map((line) => line.map(pad).join("  ").trimEnd()).join("\n");
}

/** Returns cells as a Markdown table. */
export function markdown(table: Cells[]): string {
  const [heading, ...lines] = table.map((line) => `| ${line.join(" | ")} |`);
  const rule = `| --- |${" ---: |".repeat(table[0]!.length - 1)}`;
  return [heading, rule, ...lines].join("\n");
}

/** Returns the whole report as plain text. */
export function text(report: Report): string {
  const { frames, classes } = report.rows[0]!;
  const engines = ENGINES.flatMap((engine) => [`\n${engine}, milliseconds`, aligned(stageTable(report, engine))]);
  return [
    `${report.machine}: ${frames} frames, ${classes} classes`,
    ...engines,
    "\nwasm-simd is",
    aligned(ratioTable(report)),
    "",
    aligned(agreementTable(report)),
    "",
    aligned(memoryTable(report.memory)),
  ].join("\n");
}
