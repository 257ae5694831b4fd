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
  readonly #dropped = new Map<string, ArrayBuffer>();
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
  add(fileName: string, bytes: ArrayBuffer, exact?: ExactPoses): string {
    const base = fileName.replace(/\.bvh$/i, "") || "motion";
    let name = base;
    for (let n = 2; this.has(name) && !sameBytes(this.#dropped.get(name), bytes); n++) name = `${base} (${n})`;
    this.#dropped.set(name, bytes);
    if (exact) this.#exact.set(name, exact);
    this.onChange();
    return name;
  }

  /** Keeps what is said of how a file is read, also of one that is yet to be added. */
  say(name: string, reading: FileReading): void {
    this.#readings.set(name, reading);
    this.onChange();
  }

  /** Forgets a file that could not be opened. */
  remove(name: string): void {
    this.#dropped.delete(name);
    this.#readings.delete(name);
    this.#exact.delete(name);
    this.onChange();
  }

  /** What the engine opens for a name; `undefined` where there is no such input. */
  source(name: string): InputSource | undefined {
    const bytes = this.#dropped.get(name);
    const exact = this.#exact.get(name);
    const reading = this.#readings.get(name);
    if (bytes) return { kind: "bvh", name, bytes, ...(exact && { exact }), ...(reading && { reading }) };
    if (!this.builtIn.includes(name)) return undefined;
    const set = this.builtInSet;
    return { kind: "built-in", name, ...(set && { set }) };
  }
}

function sameBytes(a: ArrayBuffer | undefined, b: ArrayBuffer): boolean {
  if (!a || a.byteLength !== b.byteLength) return false;
  const [left, right] = [new Uint8Array(a), new Uint8Array(b)];
  return left.every((value, i) => value === right[i]);
}
