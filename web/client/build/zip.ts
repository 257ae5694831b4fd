/**
 * Reads zip archives file by file: the directory at the end first, then each entry on its own, so that an archive of
 * any size takes the memory of one file. Limits apply to the actual number of unpacked bytes, not to the size stated in
 * the archive.
 */
import { crc32 } from "./crc32";

/** Maximum number of bytes of an archive's directory, and maximum number of entries. */
const MAX_DIRECTORY_BYTES = 64 << 20;
export const MAX_ENTRIES = 200_000;
/** Maximum number of bytes of an empty deflate stream. */
const EMPTY_BYTES = 2;
/** An entry is refused if it unpacks to more than `BOMB_BYTES` and to more than `BOMB_RATIO` times its packed size. */
const BOMB_BYTES = 16 << 20;
const BOMB_RATIO = 200;

/** Bytes per read of the file. */
const WINDOW_BYTES = 1 << 20;

const END = 0x06054b50;
const END_64 = 0x06064b50;
const LOCATOR_64 = 0x07064b50;
const ENTRY = 0x02014b50;
const LOCAL = 0x04034b50;
const STORED = 0;
const DEFLATED = 8;

/** A file in an archive. */
export interface ZipEntry {
  /** Path with `/`, as stated in the archive. It may lead out of the archive, so it is shown but never opened. */
  name: string;
  packedBytes: number;
  /** Unpacked size as stated in the archive. */
  bytes: number;
  /** CRC-32 of the unpacked bytes. */
  crc: number;
  method: number;
  encrypted: boolean;
  /** Offset of its local header. */
  offset: number;
}

/** The error of an invalid archive or entry; its message is a sentence. */
export class ZipError extends Error {}

/** The files in an archive; folders are left out. */
export async function readDirectory(archive: Archive): Promise<ZipEntry[]> {
  const { offset, size, count } = await findDirectory(archive);
  if (count > MAX_ENTRIES) throw new ZipError(`The archive has ${count} files; the limit is ${MAX_ENTRIES}.`);
  if (size > MAX_DIRECTORY_BYTES || offset + size > archive.file.size) throw damaged();
  const view = viewOf(await archive.bytes(offset, offset + size));
  const entries: ZipEntry[] = [];
  let at = 0;
  for (let i = 0; i < count; i++) {
    if (at + 46 > view.byteLength || view.getUint32(at, true) !== ENTRY) throw damaged();
    const [nameLength, extraLength, commentLength] = [28, 30, 32].map((field) => view.getUint16(at + field, true));
    const flags = view.getUint16(at + 8, true);
    const nameAt = at + 46;
    const next = nameAt + nameLength! + extraLength! + commentLength!;
    if (next > view.byteLength) throw damaged();
    const name = nameOf(new Uint8Array(view.buffer, view.byteOffset + nameAt, nameLength!));
    const [bytes, packedBytes, start] = widened(view, at, nameAt + nameLength!, extraLength!);
    if (!name.endsWith("/"))
      entries.push({
        name,
        packedBytes,
        bytes,
        crc: view.getUint32(at + 16, true),
        method: view.getUint16(at + 10, true),
        encrypted: (flags & 1) !== 0,
        offset: start,
      });
    at = next;
  }
  return entries;
}

/**
 * The bytes of an entry, at most `max` of them.
 * @throws ZipError if it has more, is damaged, or uses another compression method
 */
export async function readEntry(archive: Archive, entry: ZipEntry, max: number): Promise<Uint8Array<ArrayBuffer>> {
  if (entry.encrypted)
    throw new ZipError("It is encrypted. Unpack the archive with its password, then drop the files.");
  if (entry.method !== STORED && entry.method !== DEFLATED)
    throw new ZipError("Its compression method is not supported. Pack the archive again as a plain zip.");
  if (entry.method === DEFLATED && entry.packedBytes <= EMPTY_BYTES) return checked(new Uint8Array(), entry);
  const header = viewOf(await archive.bytes(entry.offset, entry.offset + 30));
  if (header.byteLength < 30 || header.getUint32(0, true) !== LOCAL) throw damaged();
  const start = entry.offset + 30 + header.getUint16(26, true) + header.getUint16(28, true);
  const packed = await archive.stream(start, start + entry.packedBytes);
  const stream = entry.method === STORED ? packed : packed.pipeThrough(new DecompressionStream("deflate-raw"));
  const limit = Math.min(max, Math.max(BOMB_BYTES, BOMB_RATIO * entry.packedBytes));
  const sentence =
    limit < max
      ? `It unpacks to more than ${BOMB_RATIO} times its size, so it cannot be a motion.`
      : `It unpacks to more than the limit of ${max >> 20} MB.`;
  return checked(await gather(stream, Math.min(entry.bytes, limit), limit, sentence), entry);
}

/** The bytes of an entry, after checking them against the checksum in the directory. */
function checked(bytes: Uint8Array<ArrayBuffer>, { crc }: ZipEntry): Uint8Array<ArrayBuffer> {
  if (crc32(bytes) !== crc) throw new ZipError("It is damaged: its checksum does not match its content.");
  return bytes;
}

/** An archive that is read in windows, so that thousands of small entries do not need thousands of reads. */
export class Archive {
  private window: { start: number; bytes: Uint8Array<ArrayBuffer> } = { start: 0, bytes: new Uint8Array() };

  constructor(readonly file: Blob) {}

  /** The bytes of a range, cut to the end of the archive. */
  async bytes(from: number, to: number): Promise<Uint8Array<ArrayBuffer>> {
    const within = () => this.window.start <= from && to <= this.window.start + this.window.bytes.length;
    if (!within()) {
      const part = this.file.slice(from, Math.max(to, from + WINDOW_BYTES));
      this.window = { start: from, bytes: new Uint8Array(await part.arrayBuffer()) };
    }
    return this.window.bytes.subarray(from - this.window.start, to - this.window.start);
  }

  /** The bytes of a range, all of which must exist. */
  async stream(from: number, to: number): Promise<ReadableStream<Uint8Array<ArrayBuffer>>> {
    if (to > this.file.size) throw damaged();
    if (to - from > WINDOW_BYTES) return this.file.slice(from, to).stream();
    const bytes = await this.bytes(from, to);
    return new ReadableStream({
      start(controller) {
        if (bytes.length > 0) controller.enqueue(bytes);
        controller.close();
      },
    });
  }
}

/** All bytes of a stream, if they are at most `limit`; `expected` is a guess of their number. */
async function gather(
  stream: ReadableStream<Uint8Array>,
  expected: number,
  limit: number,
  tooLarge: string,
): Promise<Uint8Array<ArrayBuffer>> {
  let bytes = new Uint8Array(Math.max(expected, 1 << 12));
  let length = 0;
  const reader = stream.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return bytes.subarray(0, length);
      if (length + value.length > limit) throw new ZipError(tooLarge);
      if (length + value.length > bytes.length) {
        const larger = new Uint8Array(Math.min(limit, Math.max(2 * bytes.length, length + value.length)));
        larger.set(bytes.subarray(0, length));
        bytes = larger;
      }
      bytes.set(value, length);
      length += value.length;
    }
  } catch (thrown) {
    await reader.cancel().catch(() => {});
    throw thrown instanceof ZipError ? thrown : new ZipError("It is damaged: it cannot be unpacked.");
  }
}

/** Finds the directory through the record at the end of the archive, which may be followed by a comment. */
async function findDirectory(archive: Archive): Promise<{ offset: number; size: number; count: number }> {
  const tailAt = Math.max(0, archive.file.size - (22 + 0xffff));
  const tail = viewOf(await archive.bytes(tailAt, archive.file.size));
  let end = tail.byteLength - 22;
  while (end >= 0 && tail.getUint32(end, true) !== END) end--;
  if (end < 0) throw new ZipError("This is not a zip archive, or it is incomplete.");
  const found = {
    count: tail.getUint16(end + 10, true),
    size: tail.getUint32(end + 12, true),
    offset: tail.getUint32(end + 16, true),
  };
  const isWide = found.count === 0xffff || found.size === 0xffffffff || found.offset === 0xffffffff;
  const locator = end - 20;
  if (!isWide || locator < 0 || tail.getUint32(locator, true) !== LOCATOR_64) return found;
  const at = Number(tail.getBigUint64(locator + 8, true));
  const wide = viewOf(await archive.bytes(at, at + 56));
  if (wide.byteLength < 56 || wide.getUint32(0, true) !== END_64) throw damaged();
  return {
    count: Number(wide.getBigUint64(32, true)),
    size: Number(wide.getBigUint64(40, true)),
    offset: Number(wide.getBigUint64(48, true)),
  };
}

/** Size, packed size and offset of a directory entry, from its extra field if they need 64 bits. */
function widened(view: DataView, at: number, extraAt: number, extraLength: number): [number, number, number] {
  const values = [view.getUint32(at + 24, true), view.getUint32(at + 20, true), view.getUint32(at + 42, true)];
  for (let field = extraAt; field + 4 <= extraAt + extraLength; ) {
    const [id, size] = [view.getUint16(field, true), view.getUint16(field + 2, true)];
    if (id === 1) {
      let next = field + 4;
      for (const [i, value] of values.entries()) {
        if (value !== 0xffffffff || next + 8 > Math.min(field + 4 + size, extraAt + extraLength)) continue;
        values[i] = Number(view.getBigUint64(next, true));
        next += 8;
      }
    }
    field += 4 + size;
  }
  return values as [number, number, number];
}

/** Names are read as UTF-8, flagged or not; names that are not valid UTF-8 are read as Windows-1252. */
function nameOf(bytes: Uint8Array): string {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes).replaceAll("\\", "/");
  } catch {
    return new TextDecoder("windows-1252").decode(bytes).replaceAll("\\", "/");
  }
}

function viewOf(bytes: Uint8Array<ArrayBuffer>): DataView<ArrayBuffer> {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

function damaged(): ZipError {
  return new ZipError("The archive is damaged: its directory does not match its content.");
}
