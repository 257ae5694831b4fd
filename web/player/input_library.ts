/** The inputs that can be chosen: the engine's built-in ones and the files that were dropped on this page. */
import type { BuiltInSet, ExactPoses, FileReading, InputSource } from "../client/protocol";

/** Name of the input that is steered instead of played. */
export const DRIVE = "drive";
/** Beginning of the names of inputs that are performed live; their addresses follow. */
export const LIVE = "live:";

/** Whether an input is performed live. */
export const isLive = (name: string): boolean => name.startsWith(LIVE);

/** A clip of a database: its number there, and its name. */
export interface LibraryClip {
  clip: number;
  name: string;
}

/** A file that was dropped. */
export interface DroppedInput {
  name: string;
  file: Blob;
  /** The poses that it was written from. */
  exact?: ExactPoses;
  /** What was said of how it is read. */
  reading?: FileReading;
}

/** Most clips of a database that a list offers. */
export const MOST_CLIPS = 60;

const CLIP = "clip:";

/** The value of a clip of the open database in a list of inputs. */
export const clipValue = (clip: number): string => `${CLIP}${clip}`;

/** The clip of such a value; `undefined` where it is another input. */
export const clipIn = (value: string): number | undefined =>
  value.startsWith(CLIP) ? Number(value.slice(CLIP.length)) : undefined;

export class InputLibrary {
  /** Neutral clips of the open database, which become files when they are chosen. */
  clips: readonly LibraryClip[] = [];
  builtIn: readonly string[] = [];
  /** The set that {@link builtIn} is of; all built-in motions where there is none. */
  builtInSet: BuiltInSet | undefined;
  /** Called when a file was added or removed, or something was said of how one is read. */
  onChange: () => void = () => {};
  /** The browser keeps what is in a blob outside of the page's memory; the engine reads it when it opens it. */
  readonly #dropped = new Map<string, Blob>();
  /** Poses that a file was written from. */
  readonly #exact = new Map<string, ExactPoses>();
  /** What was said of how files are read. */
  readonly #readings = new Map<string, FileReading>();

  get dropped(): string[] {
    return [...this.#dropped.keys()];
  }

  /** Name of the input that a page starts with. */
  get first(): string {
    return this.builtIn[0] ?? "";
  }

  has(name: string): boolean {
    return name === DRIVE || this.builtIn.includes(name) || this.#dropped.has(name);
  }

  isDropped(name: string): boolean {
    return this.#dropped.has(name);
  }

  /**
   * Adds a file and returns the name it goes by: its own, with a number where that belongs to another one. The same
   * file keeps its name.
   */
  async add(fileName: string, bytes: BlobPart, exact?: ExactPoses): Promise<string> {
    const file = bytes instanceof Blob ? bytes : new Blob([bytes]);
    const base = fileName.replace(/\.bvh$/i, "") || "motion";
    let name = base;
    for (let n = 2; this.has(name) && !(await sameBytes(this.#dropped.get(name), file)); n++) name = `${base} (${n})`;
    this.#dropped.set(name, file);
    if (exact) this.#exact.set(name, exact);
    this.onChange();
    return name;
  }

  /** Keeps what is said of how a file is read, also of one that is yet to be added. */
  say(name: string, reading: FileReading): void {
    this.#readings.set(name, reading);
    this.onChange();
  }

  /** A dropped file, with what is known of it; `undefined` where there is none of that name. */
  file(name: string): DroppedInput | undefined {
    const file = this.#dropped.get(name);
    const exact = this.#exact.get(name);
    const reading = this.#readings.get(name);
    return file && { name, file, ...(exact && { exact }), ...(reading && { reading }) };
  }

  /** Adds a file once more that was removed, as it was. */
  async bringBack({ name, file, exact, reading }: DroppedInput): Promise<void> {
    const added = await this.add(name, file, exact);
    if (reading) this.say(added, reading);
  }

  /** Forgets a file. */
  remove(name: string): void {
    this.#dropped.delete(name);
    this.#readings.delete(name);
    this.#exact.delete(name);
    this.onChange();
  }

  /** What the engine opens for a name; `undefined` where there is no such input. */
  source(name: string): InputSource | undefined {
    const dropped = this.file(name);
    if (dropped) {
      const { file, ...said } = dropped;
      return { kind: "bvh", bytes: file, ...said };
    }
    if (!this.builtIn.includes(name)) return undefined;
    const set = this.builtInSet;
    return { kind: "built-in", name, ...(set && { set }) };
  }
}

async function sameBytes(a: Blob | undefined, b: Blob): Promise<boolean> {
  if (!a || a.size !== b.size) return false;
  const [left, right] = (await Promise.all([a.arrayBuffer(), b.arrayBuffer()])).map((bytes) => new Uint8Array(bytes));
  return left!.every((value, i) => value === right![i]);
}
