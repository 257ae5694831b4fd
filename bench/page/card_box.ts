/** The box of the GPU: the paper's search on it, compared with Strut's. */
import { html } from "../../web/ui/dom";
import { type Card, findCard } from "../graphics_bench";
import { type GraphicsComparison, medianOf, type Report } from "../report";
import { milliseconds, PAPER_MS } from "../table";
import { table } from "./tables";

/** The box on the page. */
export interface CardBox {
  element: HTMLElement;
  /** The GPU that can be measured, once it is known. */
  ready: Promise<Card | undefined>;
  /** Resets the box. */
  clear(): void;
  /** @param fault why the GPU could not be measured */
  show(report: Report, fault?: string): void;
}

/** Creates the empty box. @param software whether a software GPU is accepted, as in tests */
export function cardBox(software: boolean): CardBox {
  const found = findCard();
  const ready = found.then((card) => (card?.software && !software ? undefined : card));
  const sentence = html("p", { role: "status" });
  const results = html("div", { class: "results" });
  const element = html(
    "section",
    { class: "card-box", "aria-labelledby": "card-heading" },
    html("h2", { id: "card-heading" }, "GPU"),
    html(
      "p",
      {},
      "The paper compared every window of the database on a GPU. If this device has one, Measure does the same, one window at a time and 256 together, including upload and readback. It compares that with Strut's search on the CPU. Both must find exactly the same neighbours.",
    ),
    sentence,
    results,
    html(
      "p",
      { class: "caption" },
      "To add a GPU to docs/performance.md: measure 79,829 frames, press “Copy as JSON”, and send the result in an issue with the name of the GPU, its driver and the date.",
    ),
  );
  const box: CardBox = {
    element,
    ready,
    clear() {
      results.replaceChildren();
      void Promise.all([found, ready]).then(([found, card]) => {
        sentence.textContent = card ? `${card.name} will be measured.` : absence(found);
      });
    },
    show(report, fault) {
      if (!report.gpu) {
        if (fault) sentence.textContent = fault;
        return;
      }
      sentence.textContent = agreement(report.gpu);
      results.replaceChildren(...times(report, report.gpu));
    },
  };
  box.clear();
  return box;
}

/** Returns the reason why nothing can be measured. */
function absence(found: Card | undefined): string {
  return found
    ? "This browser emulates the GPU in software, so its times would not be those of a GPU. Only the CPU is measured."
    : "This browser has no WebGPU, so only the CPU is measured. A browser with WebGPU on a device with a GPU can measure both.";
}

function agreement({ adapter, identical, sets, candidates_per_neighbour }: GraphicsComparison): string {
  const count = (n: number) => n.toLocaleString("en");
  return `${adapter}: ${count(identical)} of ${count(sets)} sets of neighbours are identical to Strut's, with ${candidates_per_neighbour.toFixed(2)} candidates per neighbour.`;
}

function times(report: Report, { software }: GraphicsComparison): HTMLElement[] {
  if (software) return [html("p", {}, "This GPU is emulated in software, so its times are not those of a GPU.")];
  const strut = medianOf(report, "wasm-simd", "batch", "search")!;
  const paper = PAPER_MS.search!;
  const line = (name: string, ms: number) => [
    name,
    milliseconds(ms),
    ms === strut ? "" : `${(ms / strut).toFixed(1)} ×`,
    `${(paper / ms).toFixed(1)} ×`,
  ];
  return [
    ...table(
      "Search of every class from a cold start, milliseconds per window",
      ["By", "Median", "Strut is faster", "Than the paper"],
      [
        line("Strut", strut),
        line("GPU, one window", medianOf(report, "gpu-brute", "all", "search")!),
        line("GPU, 256 together", medianOf(report, "gpu-brute", "batch", "search")!),
      ],
      "Strut",
    ),
    html("p", { class: "caption" }, `The last column compares with the search of the paper, ${paper} ms.`),
  ];
}
