/** Runs the benchmark in a worker. */
import { benchmark } from "../benchmark";
import { loadInstances } from "../engines";
import type { Report } from "../report";

/** Message from the page. */
export interface Job {
  frames: number;
  machine: string;
}

/** Messages to the page. */
export type Message =
  | { kind: "progress"; what: string; done: number }
  | { kind: "report"; report: Report }
  | { kind: "failure"; reason: string };

const post = (message: Message) => self.postMessage(message);

self.onmessage = async ({ data: { frames, machine } }: MessageEvent<Job>) => {
  try {
    const instances = await loadInstances(async (url) => WebAssembly.compile(await (await fetch(url)).arrayBuffer()));
    const onProgress = (what: string, done: number) => post({ kind: "progress", what, done });
    post({ kind: "report", report: benchmark(instances, { frames }, { machine, onProgress }) });
  } catch (thrown) {
    post({ kind: "failure", reason: thrown instanceof Error ? thrown.message : String(thrown) });
  }
};
