/** The paper's search, every window on a graphics card, beside the engine's: after the other engines, on the same database. */
import { clockResolution, timedOften } from "./clock";
import { type GraphicsComparison, type Report, type Row, summarise } from "./report";
import type { Workload } from "./workload";

/** Windows that are searched for together in mode `batch`, and how many times. */
const BATCH = 256;
const BATCHES = 4;
/** Windows that are searched for one by one in mode `all`; as many are compared where times mean nothing. */
const SINGLE = 64;
/** Of each kind, what is searched first: drivers finish their compilation late. */
const WARM_UP = 3;

/** A graphics processor that a page may use. */
export interface Card {
  /** As far as the browser tells. */
  name: string;
  /** Whether a program plays its part. */
  software: boolean;
}

/** The page's fastest graphics processor; `undefined` where there is none. */
export async function findCard(): Promise<Card | undefined> {
  const gpu: GPU | undefined = navigator.gpu;
  const adapter = await gpu?.requestAdapter({ powerPreference: "high-performance" }).catch(() => null);
  if (!adapter) return undefined;
  const { vendor, architecture, description, isFallbackAdapter } = adapter.info;
  const name = description || [vendor, architecture].filter((word) => word !== "").join(" ") || "unnamed";
  return { name, software: isFallbackAdapter };
}

/** Adds what a graphics processor does to a report; times only of a real one. Loads what drives it. */
export async function benchmarkGraphics(
  report: Report,
  { bytes, queries }: Workload,
  card: Card,
  onProgress: (done: number) => void,
): Promise<void> {
  const glue = await import("./pkg/gpu/strut_bench_gpu.js");
  const module = await (await fetch(new URL("./pkg/gpu/strut_bench_gpu_bg.wasm", import.meta.url))).arrayBuffer();
  glue.initSync({ module });
  const yardstick = await glue.Yardstick.open(bytes);
  for (const { poses } of queries) yardstick.add(poses);
  const windows = yardstick.windows();
  const { frames } = report.rows[0]!;
  const classes = yardstick.classes();

  const numbers = (count: number) => Array.from({ length: count }, (_, i) => i);
  const single = Math.min(SINGLE, windows);
  const batch = Math.min(BATCH, windows);
  const alone = numbers(single).map((i) => ({ first: Math.floor((i * windows) / single), count: 1 }));
  const together = numbers(Math.min(BATCHES, Math.floor(windows / batch))).map((i) => ({
    first: i * batch,
    count: batch,
  }));
  const rounds = card.software ? [alone] : [alone, together];
  const work = rounds.flat().length + WARM_UP * rounds.length;
  let done = 0;
  const times: number[][] = [];
  for (const searches of rounds) {
    const all: number[] = [];
    for (const { first, count } of [...searches.slice(0, WARM_UP), ...searches]) {
      const began = performance.now();
      await yardstick.search(first, count);
      all.push((performance.now() - began) / count);
      onProgress(done++ / work);
    }
    times.push(all.slice(Math.min(WARM_UP, searches.length)));
  }

  const compared = rounds.at(-1)!.flatMap(({ first, count }) => numbers(count).map((i) => first + i));
  const identical = compared.reduce((sum, window) => sum + yardstick.identical(window), 0);
  const comparison: GraphicsComparison = {
    adapter: card.name,
    driver: "",
    backend: "WebGPU",
    software: card.software,
    frames,
    classes,
    sets: compared.length * classes,
    identical,
    candidates_per_neighbour: yardstick.candidatesPerNeighbour(),
  };
  if (identical < comparison.sets)
    throw new Error(`The graphics processor found other neighbours: ${JSON.stringify(comparison)}`);
  const row = (engine: Row["engine"], mode: Row["mode"], samples: number[]): Row => {
    const measured = { stage: "search", mode, engine, frames, classes, ...summarise(samples) };
    report.rows.push(measured);
    return measured;
  };
  const [ofOne, ofBatches] = times;
  if (ofOne && ofBatches) {
    const resolution = clockResolution();
    const ours = compared.map((window) => timedOften(() => yardstick.searchByEngine(window), resolution));
    const engine = row("wasm-simd", "batch", ours);
    const ratio = ({ median_ms }: Row) => median_ms / engine.median_ms;
    comparison.engine_is_faster = {
      all: ratio(row("gpu-brute", "all", ofOne)),
      batch: ratio(row("gpu-brute", "batch", ofBatches)),
    };
  }
  report.gpu = comparison;
  yardstick.free();
}
