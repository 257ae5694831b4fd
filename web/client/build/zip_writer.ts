/**
 * Writes zip archives file by file, each packed when it is added: what is there already can be saved at any time. The archive
 * has no dates, so that the same files give the same bytes.
 */
import { crc32 } from "./crc32";
import { ZipError } from "./zip";

/** Without fields of 64 bits, which not every program reads: maximum number of bytes and of entries. */
const MAX_BYTES = 0xffff_fffe;
const MAX_ENTRIES = 0xfffe;

/** Names are UTF-8. */
const FLAGS = 0x800;
/** Version 2.0 of the format has deflation. */
const VERSION = 20;
/** 1 January 1980, the first day that the format knows. */
const DATE = 0x21;
const DEFLATED = 8;

/** A part of an archive: numbers of 16 or 32 bits, as `[bytes, value]`. */
type Fields = readonly (readonly [2 | 4, number])[];

export class ZipWriter {
  readonly #parts: BlobPart[] = [];
  readonly #directory: BlobPart[] = [];
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

  /** Bytes of the archive as it is now, without its end. */
  get bytes(): number {
    return this.#bytes + this.#directoryBytes;
  }

  /**
   * Adds a file; `packed` says whether it is worth deflating.
   * @param name path with `/`, which no other entry may have
   * @throws ZipError if there is no room for it, and nothing has changed then
   */
  async add(name: string, bytes: Uint8Array<ArrayBuffer>, packed = true): Promise<void> {
    const crc = crc32(bytes);
    const deflated = packed ? await deflate(bytes) : undefined;
    const content = deflated && deflated.size < bytes.length ? deflated : new Blob([bytes]);
    const encoded = new TextEncoder().encode(name);
    if (this.#names.has(name)) throw new ZipError(`The archive would have two files “${name}”.`);
    const method = content === deflated ? DEFLATED : 0;
    const common: Fields = [
      [2, VERSION],
      [2, FLAGS],
      [2, method],
      [2, 0],
      [2, DATE],
      [4, crc],
      [4, content.size],
      [4, bytes.length],
      [2, encoded.length],
    ];
    const head = fields([[4, 0x04034b50], ...common, [2, 0]]);
    const entry = fields([
      [4, 0x02014b50],
      [2, VERSION],
      ...common,
      ...([2, 2, 2, 2, 4] as const).map((size) => [size, 0] as const),
      [4, this.#bytes],
    ]);
    const grows = head.length + content.size + entry.length + 2 * encoded.length;
    if (this.entries >= MAX_ENTRIES || this.bytes + grows > this.#maxBytes || encoded.length > 0xffff)
      throw new ZipError("The archive is full. Save it, then go on with another one.");
    this.#names.add(name);
    this.#parts.push(head, encoded, content);
    this.#bytes += head.length + encoded.length + content.size;
    this.#directory.push(entry, encoded);
    this.#directoryBytes += entry.length + encoded.length;
  }

  /** The archive with what was added until now; more may be added afterwards. */
  archive(type = "application/zip"): Blob {
    const end = fields([
      [4, 0x06054b50],
      [2, 0],
      [2, 0],
      [2, this.entries],
      [2, this.entries],
      [4, this.#directoryBytes],
      [4, this.#bytes],
      [2, 0],
    ]);
    return new Blob([...this.#parts, ...this.#directory, end], { type });
  }
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
