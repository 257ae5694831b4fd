/**
 * A batch: every clip in every style, each file once. All lanes take clips one after another. A clip that cannot be
 * used is left out and listed, and the others continue. Finished files are kept when the batch is stopped; running it
 * again makes the rest. Independent of the page.
 */
import { ZipError } from "../../client/build/zip";
import { ZipWriter } from "../../client/build/zip_writer";
import { type CallOptions, isCancellation, isFault } from "../../client/protocol";
import { errorText } from "../ui/words";
import type { Variant } from "./variants";

/** A clip to style. */
export interface BatchClip {
  /** Path of its file. */
  path: string;
  /** @throws Error with a sentence */
  read(): Promise<Uint8Array<ArrayBuffer>>;
}

/** A clip that is open in a lane's engine. */
export interface OpenClip {
  /** The bytes of a BVH file in a style. */
  style(variant: Variant, call: CallOptions): Promise<Uint8Array<ArrayBuffer>>;
  dispose(): void;
}

/** An engine that works on a batch. */
export interface Lane {
  /** @throws Error with a sentence if the clip cannot be used */
  open(name: string, bytes: Uint8Array<ArrayBuffer>, call: CallOptions): Promise<OpenClip>;
  dispose(): void;
}

/** A clip that was left out, and the reason, a sentence. */
interface LeftOut {
  path: string;
  why: string;
}

/** Number of attempts per file after a fault of the engine. */
const TRIES = 2;

export class Batch {
  readonly clips: readonly BatchClip[];
  readonly variants: readonly Variant[];
  /** Clips that were left out. */
  readonly leftOut: LeftOut[] = [];
  readonly #zip: ZipWriter;
  readonly #outputs: readonly string[];
  /** Indices of the remaining clips, in order. */
  #waiting: number[];
  /** Finished files, by their names in the zip. */
  readonly #done = new Set<string>();
  /** The result of each file, for the report. */
  readonly #rows: string[] = [];

  constructor(clips: readonly BatchClip[], variants: readonly Variant[], zip = new ZipWriter()) {
    this.clips = clips;
    this.variants = variants;
    this.#zip = zip;
    this.#outputs = outputNames(clips.map(({ path }) => path));
    this.#waiting = clips.map((_, i) => i);
  }

  /** Number of files if every clip can be used. */
  get files(): number {
    return this.clips.length * this.variants.length;
  }

  /** Number of files in the zip. */
  get done(): number {
    return this.#done.size;
  }

  /** Share of the files that were finished or left out. */
  get fraction(): number {
    const lost = this.leftOut.length * this.variants.length;
    return this.files === 0 ? 1 : Math.min(1, (this.done + lost) / this.files);
  }

  /** Whether there is nothing left to do. */
  get ended(): boolean {
    return this.#waiting.length === 0;
  }

  /** Bytes of the zip. */
  get bytes(): number {
    return this.#zip.bytes;
  }

  /**
   * Makes the remaining files.
   * @param onChange called after every file
   * @throws the reason with which `signal` was aborted; failures of clips are in {@link leftOut}
   */
  async run(lanes: readonly Lane[], onChange: () => void, { signal }: CallOptions = {}): Promise<void> {
    const call = signal ? { signal } : {};
    const work = async (lane: Lane) => {
      for (;;) {
        signal?.throwIfAborted();
        const next = this.#waiting.shift();
        if (next === undefined) return;
        try {
          await this.#clip(lane, next, call, onChange);
        } catch (thrown) {
          if (isCancellation(thrown) || signal?.aborted) {
            // It was not finished: the next run continues with it.
            this.#waiting.unshift(next);
            throw thrown;
          }
          this.#leaveOut(next, errorText(thrown));
        }
        onChange();
      }
    };
    const ended = await Promise.allSettled(lanes.map(work));
    const failed = ended.find((end) => end.status === "rejected");
    if (failed) throw failed.reason;
  }

  /** The zip of the finished files, with a report. */
  archive(): Blob {
    const rows = ["output,input,variant,status,message", ...this.#rows];
    const report = new TextEncoder().encode(rows.map((line) => `${line}\n`).join(""));
    return this.#zip.archive("application/zip", { name: "report.csv", bytes: report });
  }

  async #clip(lane: Lane, number: number, call: CallOptions, onChange: () => void): Promise<void> {
    const { path, read } = this.clips[number]!;
    const todo = this.variants.filter((variant) => !this.#done.has(this.#outputOf(number, variant)));
    const bytes = await read();
    await again(async () => {
      const clip = await lane.open(path, bytes, call);
      try {
        for (const variant of todo) {
          const output = this.#outputOf(number, variant);
          if (this.#done.has(output)) continue;
          await this.#zip.add(output, await clip.style(variant, call));
          this.#done.add(output);
          this.#rows.push(row(output, path, variant.name, "done", ""));
          onChange();
        }
      } finally {
        clip.dispose();
      }
    });
  }

  #leaveOut(number: number, why: string): void {
    const { path } = this.clips[number]!;
    this.leftOut.push({ path, why });
    for (const variant of this.variants) {
      const output = this.#outputOf(number, variant);
      if (!this.#done.has(output)) this.#rows.push(row(output, path, variant.name, "left out", why));
    }
  }

  #outputOf(number: number, { name }: Variant): string {
    return `${folderName(name)}/${this.#outputs[number]!}`;
  }
}

/** Tries again after a fault of the engine, which has restarted by then. */
async function again(work: () => Promise<void>): Promise<void> {
  for (let left = TRIES; ; left--) {
    try {
      return await work();
    } catch (thrown) {
      if (left <= 1 || !isFault(thrown) || thrown instanceof ZipError) throw thrown;
    }
  }
}

/** Paths of the outputs below the folder of a style: those of the inputs, made unique and kept inside the folder. */
export function outputNames(paths: readonly string[]): string[] {
  const taken = new Set<string>();
  return paths.map((path) => {
    const parts = path
      .replace(/\.zip\//gi, "/")
      .split(/[\\/]+/)
      .map(folderName)
      .filter((part) => part !== "");
    const base = (parts.join("/") || "motion").replace(/\.bvh$/i, "");
    let name = `${base}.bvh`;
    // Some file systems are case-insensitive.
    for (let n = 2; taken.has(name.toLowerCase()); n++) name = `${base} (${n}).bvh`;
    taken.add(name.toLowerCase());
    return name;
  });
}

/** A name that is valid as a folder or a file on every system; empty if nothing is left of it. */
function folderName(name: string): string {
  return name.replace(/[\\/:*?"<>|\p{Cc}]/gu, "-").replace(/^[\s.]+$|[\s.]+$/g, "");
}

function row(...cells: readonly string[]): string {
  return cells.map((cell) => (/[",\n\r]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell)).join(",");
}
