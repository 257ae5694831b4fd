/** Runs the benchmark in a worker. */
import { benchmark } from "../benchmark";
import { loadInstances } from "../engines";
import { benchmarkGraphics, type Card } from "../graphics_bench";
import type { Report } from "../report";
import { makeWorkload } from "../workload";

/** Message from the page. */
export interface Job {
  frames: number;
  machine: string;
  /** Number of motions that are styled; all if undefined. */
  motions?: number;
  /** The GPU that is measured, too. */
  card?: Card;
}

/** Messages to the page. */
export type Message =
  | { kind: "progress"; what: string; done: number }
  /** @property cardFault why the GPU could not be measured */
  | { kind: "report"; report: Report; cardFault?: string }
  | { kind: "failure"; reason: string };

const post = (message: Message) => self.postMessage(message);

/** The GPU's share of the work, if there is one. */
const CARD_SHARE = 0.1;

self.onmessage = async ({ data: { frames, machine, motions, card } }: MessageEvent<Job>) => {
  try {
    const instances = await loadInstances(async (url) => WebAssembly.compile(await (await fetch(url)).arrayBuffer()));
    const share = card ? 1 - CARD_SHARE : 1;
    const onProgress = (what: string, done: number) => post({ kind: "progress", what, done: share * done });
    onProgress("Making a database", 0);
    const { bytes, queries } = makeWorkload(instances.simd.glue, { frames });
    const workload = { bytes, queries: queries.slice(0, motions) };
    const report = benchmark(instances, workload, { machine, onProgress });
    if (!card) return post({ kind: "report", report });
    const onCard = (done: number) =>
      post({ kind: "progress", what: `every window: ${card.name}`, done: share + CARD_SHARE * done });
    onCard(0);
    const cardFault = await benchmarkGraphics(report, workload, card, onCard).then(() => undefined, stopped);
    post({ kind: "report", report, ...(cardFault && { cardFault }) });
  } catch (thrown) {
    post({ kind: "failure", reason: thrown instanceof Error ? thrown.message : String(thrown) });
  }
};

/** Returns the message of a GPU failure; other errors are thrown again. */
function stopped(thrown: unknown): string {
  if (thrown instanceof Error || !(thrown as { message?: string }).message) throw thrown;
  return `The GPU stopped responding: ${(thrown as { message: string }).message}`;
}
