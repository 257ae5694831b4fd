/**
 * Writes zip archives file by file, each packed when it is added, so that the current contents can be saved at any
 * time. The archive has no dates, so that the same files give the same bytes.
 */
import { crc32 } from "./crc32";
import { ZipError } from "./zip";

/** Limits without 64-bit fields, which not every program reads: maximum number of bytes and maximum number of entries. */
const MAX_BYTES = 0xffff_fffe;
const MAX_ENTRIES = 0xfffe;

/** Names are UTF-8. */
const FLAGS = 0x800;
/** Version 2.0 of the format supports deflate. */
const VERSION = 20;
/** 1 January 1980, the first date of the format. */
const DATE = 0x21;
const STORED = 0;
const DEFLATED = 8;

/** A part of an archive: numbers of 16 or 32 bits, as `[bytes, value]`. */
type Fields = readonly (readonly [2 | 4, number])[];

export class ZipWriter {
  readonly #parts: Part[] = [];
  readonly #directory: Part[] = [];
  readonly #names = new Set<string>();
  #bytes = 0;
  #directoryBytes = 0;
  readonly #maxBytes: number;

  /** @param maxBytes maximum number of bytes of the archive; tests lower it */
  constructor(maxBytes = MAX_BYTES) {
    this.#maxBytes = maxBytes;
  }

  /** Number of entries. */
  get entries(): number {
    return this.#names.size;
  }

  /** Bytes of the current archive, without its end record. */
  get bytes(): number {
    return this.#bytes + this.#directoryBytes;
  }

  /**
   * Adds a file.
   * @param name path with `/`; it must be unique
   * @param packed whether to try deflating it
   * @throws ZipError if there is no room for it; nothing has changed then
   */
  async add(name: string, bytes: Uint8Array<ArrayBuffer>, packed = true): Promise<void> {
    const deflated = packed ? await deflate(bytes) : undefined;
    const content = deflated && deflated.size < bytes.length ? deflated : new Blob([bytes]);
    const made = this.#entryOf(name, bytes, content, content === deflated ? DEFLATED : STORED);
    this.#names.add(name);
    this.#parts.push(...made.parts);
    this.#bytes += sizeOf(made.parts);
    this.#directory.push(...made.directory);
    this.#directoryBytes += sizeOf(made.directory);
  }

  /**
   * The archive of all files added so far; more may be added afterwards.
   * @param last a file that is only in this archive
   * @throws ZipError if there is no room for the last file
   */
  archive(type = "application/zip", last?: { name: string; bytes: Uint8Array<ArrayBuffer> }): Blob {
    const added = last && this.#entryOf(last.name, last.bytes, new Blob([last.bytes]), STORED);
    const entries = this.entries + (added ? 1 : 0);
    const [parts, directory] = [added?.parts ?? [], added?.directory ?? []];
    const end = fields([
      [4, 0x06054b50],
      [2, 0],
      [2, 0],
      [2, entries],
      [2, entries],
      [4, this.#directoryBytes + sizeOf(directory)],
      [4, this.#bytes + sizeOf(parts)],
      [2, 0],
    ]);
    return new Blob([...this.#parts, ...parts, ...this.#directory, ...directory, end], { type });
  }

  /** An entry after all others, and its directory record. @throws ZipError */
  #entryOf(name: string, bytes: Uint8Array<ArrayBuffer>, content: Blob, method: number): Record<Parts, Part[]> {
    if (this.#names.has(name)) throw new ZipError(`The archive already has a file “${name}”.`);
    const encoded = new TextEncoder().encode(name);
    const common: Fields = [
      [2, VERSION],
      [2, FLAGS],
      [2, method],
      [2, 0],
      [2, DATE],
      [4, crc32(bytes)],
      [4, content.size],
      [4, bytes.length],
      [2, encoded.length],
    ];
    const parts = [fields([[4, 0x04034b50], ...common, [2, 0]]), encoded, content];
    const unused = ([2, 2, 2, 2, 4] as const).map((size) => [size, 0] as const);
    const entry = fields([[4, 0x02014b50], [2, VERSION], ...common, ...unused, [4, this.#bytes]]);
    const directory = [entry, encoded];
    const room = this.bytes + sizeOf(parts) + sizeOf(directory) <= this.#maxBytes;
    if (!room || this.entries >= MAX_ENTRIES || encoded.length > 0xffff)
      throw new ZipError("The archive is full. Save it, then continue with another one.");
    return { parts, directory };
  }
}

type Part = Blob | Uint8Array<ArrayBuffer>;
type Parts = "parts" | "directory";

function sizeOf(parts: readonly Part[]): number {
  return parts.reduce((sum, part) => sum + (part instanceof Blob ? part.size : part.length), 0);
}

function fields(values: Fields): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(values.reduce((sum, [size]) => sum + size, 0));
  const view = new DataView(bytes.buffer);
  let at = 0;
  for (const [size, value] of values) {
    if (size === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += size;
  }
  return bytes;
}

function deflate(bytes: Uint8Array<ArrayBuffer>): Promise<Blob> {
  return new Response(new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate-raw"))).blob();
}
