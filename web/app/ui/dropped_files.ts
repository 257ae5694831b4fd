/** Dropped or selected files and folders, each with its path. */
import type { DroppedFile } from "../../client/build/protocol";

/** Deepest nesting of folders, and maximum number of files. */
const MAX_DEPTH = 16;
const MAX_FILES = 200_000;

/** The files of a drop, including those in folders. It must be called in the event itself; folders are read asynchronously. */
export function filesOfDrop(transfer: DataTransfer): Promise<DroppedFile[]> {
  const entries = [...transfer.items].map((item) => {
    const entry = item.kind === "file" ? item.webkitGetAsEntry() : null;
    return entry?.isDirectory ? entry : item.getAsFile();
  });
  return collect(entries.filter((entry) => entry !== null));
}

/** The files of a file dialog; those of a folder have their paths. */
export function filesOfDialog(files: Iterable<File>): DroppedFile[] {
  return Array.from(files, (file) => ({ path: file.webkitRelativePath || file.name, file }));
}

async function collect(entries: (File | FileSystemEntry)[]): Promise<DroppedFile[]> {
  const found: DroppedFile[] = [];
  for (const entry of entries) {
    if (entry instanceof File) found.push({ path: entry.name, file: entry });
    else await walk(entry, "", 0, found);
  }
  return found;
}

async function walk(entry: FileSystemEntry, folder: string, depth: number, found: DroppedFile[]): Promise<void> {
  const path = folder + entry.name;
  if (found.length >= MAX_FILES || depth > MAX_DEPTH) return;
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
    found.push({ path, file });
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    // A reader returns a hundred entries at a time.
    const entries = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (entries.length === 0) return;
    for (const inner of entries) await walk(inner, `${path}/`, depth + 1, found);
  }
}
