/** The benchmark page: starts the benchmark, shows its progress, and prints the results. */
import "../../web/app/shell/trusted_types";
import "../../web/ui/tokens.css";
import "../../web/app/ui/type.css";
import "../../web/ui/controls.css";
import "../../web/app/ui/wordmark.css";
import "./bench.css";
import { html } from "../../web/ui/dom";
import { PAPER_FRAMES } from "../benchmark";
import { medianOf, type Report, speedUp } from "../report";
import type { Job, Message } from "./bench_worker";
import { cardBox } from "./card_box";
import { tables } from "./tables";

const SIZES: readonly [frames: number, name: string][] = [
  [4_800, "4,800 frames"],
  [20_000, "20,000 frames"],
  [PAPER_FRAMES, "79,829 frames, as in the paper"],
  [400_000, "400,000 frames"],
];

const size = html("select", {}, ...SIZES.map(([frames, name]) => html("option", { value: frames }, name)));
size.value = String(PAPER_FRAMES);
const start = html("button", { class: "button outlined first", type: "button" }, "Measure");
const cancel = html("button", { class: "button outlined", type: "button", hidden: true }, "Cancel");
const copy = html("button", { class: "button outlined", type: "button", hidden: true }, "Copy as JSON");
const bar = html("progress", { max: 1, "aria-label": "Progress" });
const doing = html("p", { role: "status" });
const progress = html("div", { class: "progress", hidden: true }, bar, doing);
const error = html("p", { class: "error", role: "alert" });
const results = html("div", { class: "results" });
/** For tests: `gpu=any` accepts a software GPU, `motions=N` styles only N motions. */
const parameters = new URLSearchParams(location.search);
const box = cardBox(parameters.get("gpu") === "any");

document
  .getElementById("bench")!
  .replaceChildren(
    html("h1", {}, "How long a frame takes"),
    html(
      "p",
      {},
      "This page makes a procedural database of 48 classes, and motion that is not in the database. The engine styles this motion, compiled with and without SIMD. Plain loops after the paper, in Rust and in JavaScript, do the same and must give the same result. This takes a few minutes; keep the tab in the foreground.",
    ),
    html("div", { class: "controls" }, html("label", {}, "Database", size), start, cancel, copy),
    progress,
    error,
    results,
    box.element,
  );

let worker: Worker | undefined;

function stop(): void {
  worker?.terminate();
  worker = undefined;
  progress.hidden = cancel.hidden = true;
  start.disabled = size.disabled = false;
}

function show(report: Report): void {
  const frame = medianOf(report, "wasm-simd", "unlabelled", "frame")!;
  const figure = (value: string, what: string) => html("div", {}, html("dt", {}, what), html("dd", {}, value));
  results.replaceChildren(
    html(
      "dl",
      { class: "figures" },
      figure(`${frame.toFixed(frame < 1 ? 2 : 1)} ms`, "a frame, unlabelled"),
      figure(`${speedUp(report, "wasm-naive", "unlabelled").toFixed(1)} ×`, "faster than plain Rust"),
      figure(`${speedUp(report, "js-naive", "unlabelled").toFixed(1)} ×`, "faster than plain JavaScript"),
    ),
    ...tables(report),
    html("p", { class: "caption" }, report.machine),
  );
  copy.hidden = false;
  copy.onclick = () => void navigator.clipboard.writeText(JSON.stringify(report, null, 2)).then(confirmCopy, denyCopy);
}

function confirmCopy(): void {
  copy.textContent = "Copied";
  setTimeout(() => {
    copy.textContent = "Copy as JSON";
  }, 2000);
}

function denyCopy(): void {
  error.textContent = "The browser does not allow this page to use the clipboard.";
}

start.onclick = () => {
  error.textContent = "";
  results.replaceChildren();
  box.clear();
  copy.hidden = true;
  progress.hidden = cancel.hidden = false;
  start.disabled = size.disabled = true;
  bar.value = 0;
  doing.textContent = "Loading";
  worker = new Worker(new URL("./bench_worker.ts", import.meta.url), { type: "module" });
  worker.onmessage = ({ data }: MessageEvent<Message>) => {
    if (data.kind === "progress") {
      bar.value = data.done;
      doing.textContent = `${data.what}, ${Math.round(100 * data.done)} %`;
      return;
    }
    stop();
    if (data.kind === "report") {
      show(data.report);
      box.show(data.report, data.cardFault);
    } else error.textContent = data.reason;
  };
  worker.onerror = ({ message }) => {
    stop();
    error.textContent = message || "The benchmark could not be started. Reload the page.";
  };
  const machine = `${navigator.userAgent}, ${navigator.hardwareConcurrency} threads`;
  const started = worker;
  const job: Job = { frames: Number(size.value), machine };
  if (parameters.has("motions")) job.motions = Number(parameters.get("motions"));
  void box.ready.then((card) => started.postMessage({ ...job, ...(card && { card }) } satisfies Job));
};
cancel.onclick = stop;
