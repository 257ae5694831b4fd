/** docs/performance.md: every measurement with its machine and its command. */
import { CARDS, type Card } from "./cards";
import type { LargeReport } from "./large";
import { MODES, type Report, type Row } from "./report";
import { agreementTable, type Cells, markdown, memoryTable, milliseconds, ratioTable, stageTable } from "./table";

/** A report and the command that made it. */
export interface Measured<R> {
  command: string;
  report: R;
}

/** Output of `strut bench --json`. */
export type NativeReport = Pick<Report, "machine" | "rows">;

const thousands = (n: number) => n.toLocaleString("en-US");

/** Returns the medians of the whole frame and of the search by the size of the database. */
function growthTable(rows: Row[]): Cells[] {
  const sizes = [...new Set(rows.map((row) => row.frames))];
  const median = (frames: number, mode: string, stage: string) => {
    const row = rows.find((r) => r.frames === frames && r.mode === mode && r.stage === stage);
    return row ? milliseconds(row.median_ms) : "";
  };
  const stages = ["frame", "search", "cold search"];
  return [
    ["frames", ...stages.flatMap((stage) => MODES.map((mode) => `${stage}, ${mode}`))],
    ...sizes.map((frames) => [
      thousands(frames),
      ...stages.flatMap((stage) => MODES.map((mode) => median(frames, mode, stage))),
    ]),
  ];
}

function wasmSection(title: string, { command, report }: Measured<Report>): string[] {
  const { frames, classes } = report.rows[0]!;
  return [
    `## ${title}`,
    `${thousands(frames)} frames in ${classes} classes; ${report.machine}; \`${command}\`.`,
    "Times of Strut (WASM with SIMD) in milliseconds, and those of the paper's Table 2, whose search ran on a GPU:",
    markdown(stageTable(report, "wasm-simd")),
    "This is how many times faster it is than the same engine without SIMD, and than the plain loops:",
    markdown(ratioTable(report)),
    "The plain loops must find the same neighbours as the engine. A set is *tied* if it differs only in windows that are, within rounding, as distant as the last neighbour. The other columns have the largest difference of a predicted joint angle (radians), of a frame's duration and of the likelihood of a contact:",
    markdown(agreementTable(report)),
    MEMORY,
    markdown(memoryTable(report.memory)),
  ];
}

/** Text above the table of memory. */
const MEMORY =
  "The table has the WASM memory with the database open, after styling one clip with one style and with three, and after styling a clip of every class. Targets are computed when they are first read, and kept.";

function largeSection({ command, report }: Measured<LargeReport>): string[] {
  const { frames, file_mb, open_ms, first_open_ms, memory, frame } = report;
  return [
    "## A large database in WebAssembly",
    `${thousands(frames)} procedural frames, a file of ${file_mb.toFixed(0)} MB; the same machine; \`${command}\`. With its bytes in memory, it opens in ${milliseconds(open_ms)} ms (the first time in ${milliseconds(first_open_ms)} ms).`,
    MEMORY,
    markdown(memoryTable([memory])),
    markdown([
      ["frame, milliseconds", "median", "p95"],
      ...Object.entries(frame).map(([mode, t]) => [mode, milliseconds(t.median_ms), milliseconds(t.p95_ms)]),
    ]),
  ];
}

/** Returns the section about the exhaustive search on GPUs, as in the paper. */
function cardsSection(cards: readonly Card[]): string[] {
  const ratio = (n?: number) => (n === undefined ? "" : `${n.toFixed(n < 1 ? 2 : 1)} ×`);
  const rows = cards
    .filter((card) => !card.software)
    .map((card) => [
      `${card.adapter} (${card.backend}, ${card.driver}), ${card.date}`,
      thousands(card.frames),
      milliseconds(card.all_ms),
      milliseconds(card.batch_ms),
      ratio(card.engine_is_faster?.all),
      ratio(card.engine_is_faster?.batch),
      `${thousands(card.identical)} of ${thousands(card.sets)}`,
    ]);
  return [
    "## Comparison with every window on a GPU",
    "The paper compared every window on a GPU. `strut bench --gpu` does the same, for one query at a time (*all*) and for 256 together (*batch*). In the same run it measures the engine's search from a cold start on one thread. It checks that the sets of neighbours are bit-identical, and prints the name of the GPU and its driver. In a browser, the box *GPU* of `bench.html` does the same with WebGPU, after the other engines.",
    rows.length
      ? markdown([
          ["GPU", "frames", "all, ms", "batch, ms per query", "engine faster: all", "batch", "identical sets"],
          ...rows,
        ])
      : "No GPU has been measured yet. An emulated GPU shows whether the kernels are correct, but not how fast they are. The tests run on Chromium's (`cargo test -p strut-motion-gpu`), and its times are not shown.",
    "To add a GPU, run `npm run bench -- --gpu --json card.json` on its machine. Copy `gpu` and the medians of the rows `gpu-brute` from that file into `bench/cards.ts`, with the date. `npm run bench -- --write` then updates this page. Or open `bench.html` on that machine, measure 79,829 frames, and send the result of *Copy as JSON* in an issue. Add the driver, which browsers do not report, and the date.",
  ];
}

/** The first load of the page, measured by hand. */
const FIRST_LOAD = [
  "## First load of the page",
  `\`npm run budget -- --first-load\` loads \`dist/\` in Lighthouse's mobile profile, in a Chromium that composites with an emulated GPU. The plain command is \`npx lighthouse URL --only-categories=performance\`, with \`dist/\` behind any static server with gzip.`,
  `Without a GPU, the Chromium of the plain command composites in software. It would read every displayed WebGL picture back while the page commits the frame, and the page would wait 38 to 41 ms per frame in the median: Lighthouse, which multiplies that by four, scored 55 and 58. The page therefore reads its frames back itself, without waiting (\`web/viewer/stage/frame_reader.ts\`). On 2026-11-30 a commit took 0.3 to 0.9 ms in the median, and three runs on two cores scored 81, 86 and 80: first contentful paint 1.9 s, largest contentful paint 2.9 to 3.0 s, blocking time 0.3 to 0.6 s. The page's own processor time blocks for 54 to 122 ms at fourfold slowdown; the rest of the blocking time waits for a core, as the emulated GPU draws on both.`,
];

/** Returns the whole page. */
export function document(
  date: string,
  procedural: Measured<Report>,
  recorded: Measured<Report> | undefined,
  large: Measured<LargeReport>,
  native: Measured<NativeReport>,
): string {
  const parts = [
    "# Performance",
    `Written by \`npm run bench -- --write\` on ${date}. Times are medians and 95th percentiles of single frames on one thread. Compare them within a table, not between machines.`,
    "*Labelled*: the action and the style of the input are known, so only one class is searched. *Unlabelled*: every class is searched, but classes of negligible weight are excluded from the regression. *All*: every class is included. A *cold search* does not use the previous frame. A *first search* has only one frame, which counts as standing still; a database of moving people has nothing similar. The plain loops (`bench/naive.ts` and `rust/strut-wasm/src/engine/bench/naive.rs`) do the search, the regression, the durations and the contacts. The engine's frame also includes features, blending and feet, so the ratios of whole frames are slightly too low.",
    ...wasmSection("In WebAssembly", procedural),
    ...(recorded ? wasmSection("In WebAssembly, on recorded motion", recorded) : []),
    ...largeSection(large),
    "## Native times by size of the database",
    `${native.report.machine}; \`${native.command}\`. Medians in milliseconds.`,
    markdown(growthTable(native.report.rows)),
    ...cardsSection(CARDS),
    ...FIRST_LOAD,
    "",
  ];
  return parts.join("\n\n").replace(/\n+$/, "\n");
}
