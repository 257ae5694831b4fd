/** Finds the clips among dropped files and archives. Their bytes are read on demand. */
import type { DroppedFile } from "./protocol";
import { Archive, readDirectory, readEntry, type ZipEntry, ZipError } from "./zip";

/** Maximum number of bytes of one clip, as in `strut_formats::bvh`. */
const MAX_CLIP_BYTES = 256 << 20;
/** Maximum number of unpacked bytes of one archive: its clips and licences together. */
const MAX_ARCHIVE_BYTES = 4 * 2 ** 30;
/** Maximum number of clips, as in `strut_formats::strutdb`. */
const MAX_CLIPS = 100_000;

/** A clip that can be read. */
export interface Source {
  path: string;
  /** @throws Error with a sentence as its message */
  read(): Promise<Uint8Array<ArrayBuffer>>;
}

/** The clips and licences among files. */
export interface Sources {
  /** Sorted by path, without duplicates. */
  clips: Source[];
  /** Files with the licence of the clips next to them. */
  licences: Source[];
  notes: string[];
}

/** Names of licence files, of which the first existing one counts, and their maximum size; as in `strut_formats::corpus`. */
export const LICENCE_NAMES = ["LICENSE", "LICENSE.txt", "LICENSE.md", "LICENCE"];
const MAX_LICENCE_BYTES = 1 << 20;

const isLicence = (path: string): boolean => LICENCE_NAMES.includes(path.slice(path.lastIndexOf("/") + 1));
const isBvh = (path: string): boolean => /\.bvh$/i.test(path);

/**
 * All BVH files among the files, including those in archives.
 * @param archiveBytes maximum number of unpacked bytes of one archive
 */
export async function findSources(
  files: readonly DroppedFile[],
  archiveBytes: number = MAX_ARCHIVE_BYTES,
): Promise<Sources> {
  const found = new Map<string, Source>();
  const licences: Source[] = [];
  const notes: string[] = [];
  for (const { path, file } of files) {
    if (/\.zip$/i.test(path)) {
      try {
        await addArchive(path, file, archiveBytes, found, licences, notes);
      } catch (thrown) {
        notes.push(`“${path}”: ${reasonOf(thrown)}`);
      }
    } else if (isBvh(path)) found.set(path, { path, read: () => readFile(file, MAX_CLIP_BYTES) });
    else if (isLicence(path)) licences.push({ path, read: () => readFile(file, MAX_LICENCE_BYTES) });
  }
  if (found.size > MAX_CLIPS) notes.push(`There are ${found.size} clips; the first ${MAX_CLIPS} are used.`);
  const clips = [...found.values()].sort((a, b) => (a.path < b.path ? -1 : 1)).slice(0, MAX_CLIPS);
  return { clips, licences, notes };
}

/** The reason of a failed read, as a sentence. */
export function reasonOf(thrown: unknown): string {
  // Thrown by the browser for a file that was moved or changed since it was dropped.
  if (thrown instanceof DOMException) return "It could not be read. Drop it again.";
  return thrown instanceof Error ? thrown.message : String(thrown);
}

async function readFile(file: File, max: number): Promise<Uint8Array<ArrayBuffer>> {
  if (file.size > max) throw new ZipError(`It has more than the limit of ${max >> 20} MB.`);
  return new Uint8Array(await file.arrayBuffer());
}

async function addArchive(
  path: string,
  file: File,
  archiveBytes: number,
  found: Map<string, Source>,
  licences: Source[],
  notes: string[],
): Promise<void> {
  const archive = new Archive(file);
  const read = budgetedReader(archive, archiveBytes);
  let outside = 0;
  for (const entry of await readDirectory(archive)) {
    const parts = entry.name.split("/");
    const full = `${path}/${entry.name}`;
    if (isLicence(entry.name)) licences.push({ path: full, read: () => read(entry, MAX_LICENCE_BYTES) });
    if (!isBvh(entry.name)) continue;
    if (parts.includes("..") || entry.name.startsWith("/")) {
      outside += 1;
      continue;
    }
    // macOS adds a second, unreadable file for each file.
    if (parts.some((part) => part.startsWith(".") || part === "__MACOSX")) continue;
    found.set(full, { path: full, read: () => read(entry, MAX_CLIP_BYTES) });
  }
  if (outside > 0)
    notes.push(
      `“${path}”: ${outside === 1 ? "one file has a name that leads" : `${outside} files have names that lead`} out of the archive and ${outside === 1 ? "was" : "were"} left out.`,
    );
}

/** Reads entries of an archive until `budget` bytes are unpacked. An entry counts once, however often it is read. */
function budgetedReader(archive: Archive, budget: number) {
  const counted = new Set<ZipEntry>();
  let unpacked = 0;
  return async (entry: ZipEntry, max: number): Promise<Uint8Array<ArrayBuffer>> => {
    if (!counted.has(entry) && unpacked >= budget)
      throw new ZipError(`The archive unpacks to more than ${sizeOf(budget)}; this file is beyond the limit.`);
    const bytes = await readEntry(archive, entry, max);
    if (!counted.has(entry)) unpacked += bytes.length;
    counted.add(entry);
    return bytes;
  };
}

/** Bytes in whole GB or MB. */
function sizeOf(bytes: number): string {
  return bytes >= 2 ** 30 ? `${bytes / 2 ** 30} GB` : `${bytes >> 20} MB`;
}

/** The folder of a path, with its slash. */
export function folderOf(path: string): string {
  return path.slice(0, path.lastIndexOf("/") + 1);
}
