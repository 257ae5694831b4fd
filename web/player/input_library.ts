/** The available inputs: the engine's built-in ones and the files dropped on this page. */
import type { BuiltInSet, ExactPoses, FileReading, InputSource } from "../client/protocol";

/** Name of the input that stands for driving. */
export const DRIVE = "drive";
/** Prefix of the names of live inputs; their addresses follow. */
export const LIVE = "live:";

/** Whether an input is a live performance. */
export const isLive = (name: string): boolean => name.startsWith(LIVE);

/** A clip of a database: its index and name. */
interface LibraryClip {
  clip: number;
  name: string;
}

/** A dropped file. */
export interface DroppedInput {
  name: string;
  file: Blob;
  /** The poses from which it was written. */
  exact?: ExactPoses;
  /** How the user specified that it is read. */
  reading?: FileReading;
}

/** Maximum number of clips of a database that a list offers. */
export const MOST_CLIPS = 60;

const CLIP = "clip:";

/** The value of a clip of the open database in a list of inputs. */
export const clipValue = (clip: number): string => `${CLIP}${clip}`;

/** The clip of such a value; `undefined` if it is another input. */
export const clipIn = (value: string): number | undefined =>
  value.startsWith(CLIP) ? Number(value.slice(CLIP.length)) : undefined;

export class InputLibrary {
  /** Neutral clips of the open database, which become files when they are selected. */
  clips: readonly LibraryClip[] = [];
  builtIn: readonly string[] = [];
  /** The set to which {@link builtIn} belongs; all built-in motions if `undefined`. */
  builtInSet: BuiltInSet | undefined;
  /** Called when a file was added or removed, or the reading of a file changed. */
  onChange: () => void = () => {};
  /** The browser stores a blob outside the page's memory; the engine reads it when it opens it. */
  readonly #dropped = new Map<string, Blob>();
  /** Poses from which a file was written. */
  readonly #exact = new Map<string, ExactPoses>();
  /** How the user specified that files are read. */
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
   * Adds a file and returns its name in the library: its own, with a number if another file has that name. The same
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

  /** Stores the reading of a file, also for one that is added later. */
  say(name: string, reading: FileReading): void {
    this.#readings.set(name, reading);
    this.onChange();
  }

  /** A dropped file, with its known properties; `undefined` if there is none of that name. */
  file(name: string): DroppedInput | undefined {
    const file = this.#dropped.get(name);
    const exact = this.#exact.get(name);
    const reading = this.#readings.get(name);
    return file && { name, file, ...(exact && { exact }), ...(reading && { reading }) };
  }

  /** Restores a file that was removed. */
  async bringBack({ name, file, exact, reading }: DroppedInput): Promise<void> {
    const added = await this.add(name, file, exact);
    if (reading) this.say(added, reading);
  }

  /** Removes a file. */
  remove(name: string): void {
    this.#dropped.delete(name);
    this.#readings.delete(name);
    this.#exact.delete(name);
    this.onChange();
  }

  /** The source that the engine opens for a name; `undefined` if there is no such input. */
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
