/**
 * Public data sets in the browser's cache: downloaded, checked, and removed. Received files are kept, so that a
 * cancelled download continues where it stopped.
 */
import type { DroppedFile } from "../../../client/build/protocol";
import { type CallOptions, StrutError } from "../../../client/protocol";
import { megabytes } from "../../strings/numerals";
import { strings } from "../../strings/strings";
import { filesOf, type PublicSet } from "./catalogue";

const words = strings.data.sets;

/** Where files are stored: the part of a `Cache` that is needed here. */
export interface FileCache {
  match(url: string): Promise<Response | undefined>;
  put(url: string, response: Response): Promise<void>;
  delete(url: string): Promise<boolean>;
  keys(): Promise<readonly { url: string }[]>;
}

/** Number of simultaneous downloads. */
const AT_ONCE = 6;
const CACHE = "strut-sets";

/** The browser's cache of sets. @throws StrutError if the browser has none */
export async function openCache(): Promise<FileCache> {
  try {
    return await caches.open(CACHE);
  } catch {
    throw failure(words.noCache, words.dropHere);
  }
}

/** Number of the set's files in the cache. */
export async function filesKept(set: PublicSet, cache: FileCache): Promise<number> {
  const found = await Promise.all(filesOf(set).map(({ url }) => cache.match(url)));
  for (const response of found) void response?.body?.cancel();
  return found.filter(Boolean).length;
}

/** Removes the set's files from the cache. */
export async function forgetSet(set: PublicSet, cache: FileCache): Promise<void> {
  await Promise.all(filesOf(set).map(({ url }) => cache.delete(url)));
}

/** Removes files from the cache that no set lists any more, since nothing else could use or delete them. */
export async function forgetUnlisted(sets: readonly PublicSet[], cache: FileCache): Promise<void> {
  const listed = new Set(sets.flatMap(filesOf).map(({ url }) => url));
  const unlisted = (await cache.keys()).filter(({ url }) => !listed.has(url));
  await Promise.all(unlisted.map(({ url }) => cache.delete(url)));
}

/**
 * Downloads the missing files of a set and returns all of them, as if they had been dropped. Received files are kept if
 * the download fails or is cancelled.
 * @throws StrutError that tells what to do if that fails
 */
export async function fetchSet(set: PublicSet, cache: FileCache, options: CallOptions = {}): Promise<DroppedFile[]> {
  const files = filesOf(set);
  const progress = new DownloadProgress(set, options);
  const missing: typeof files = [];
  for (const file of files) {
    const kept = await cache.match(file.url);
    if (kept) progress.done();
    else missing.push(file);
    void kept?.body?.cancel();
  }
  // The first failure aborts the remaining downloads.
  const ending = new AbortController();
  const { signal } = ending;
  if (options.signal?.aborted) ending.abort();
  options.signal?.addEventListener("abort", () => ending.abort(), { once: true });
  const queue = missing.values();
  let failed: unknown;
  const work = async () => {
    for (const file of queue) {
      if (signal.aborted) return;
      await fetchFile(set, file, cache, signal, progress).catch((error) => {
        failed ??= error;
        ending.abort();
      });
    }
  };
  await Promise.all(Array.from({ length: AT_ONCE }, work));
  if (options.signal?.aborted) throw new StrutError({ code: "cancelled", message: words.cancelled, hint: "" });
  if (failed) throw failed;
  const root = set.name;
  return Promise.all(
    files.map(async ({ path, url }) => {
      const response = await cache.match(url);
      if (!response) throw failure(words.notKept(path), words.again);
      return { path: `${root}/${path}`, file: new File([await response.blob()], path.split("/").at(-1)!) };
    }),
  );
}

/** Downloads a file into the cache. A file with a known hash is kept only if its hash is correct. */
async function fetchFile(
  set: PublicSet,
  { path, url, sha256 }: ReturnType<typeof filesOf>[number],
  cache: FileCache,
  signal: AbortSignal,
  progress: DownloadProgress,
): Promise<void> {
  const { host } = new URL(url);
  let response: Response;
  try {
    response = await fetch(url, { signal, credentials: "omit", referrerPolicy: "no-referrer" });
  } catch (error) {
    if (signal.aborted) throw error;
    // Browsers do not report why a request failed.
    const why = globalThis.navigator?.onLine === false ? words.offline : words.unreachable(host);
    throw failure(why, words.byHand(set.page));
  }
  if (!response.ok || !response.body)
    throw failure(words.answered(host, response.status, path), words.byHand(set.page));
  let bytes = 0;
  const counting = new TransformStream<Uint8Array, Uint8Array>({
    transform(chunk, controller) {
      bytes += chunk.length;
      progress.arrived(chunk.length);
      controller.enqueue(chunk);
    },
  });
  const body = new Response(response.body.pipeThrough(counting));
  try {
    // Without a hash the cache receives the file as a stream; an incomplete one is not kept.
    await cache.put(url, sha256 === undefined ? body : new Response(await checked(body, sha256, set, path)));
  } catch (error) {
    if (signal.aborted || error instanceof StrutError) throw error;
    throw (error as { name?: string }).name === "QuotaExceededError"
      ? failure(words.full(set.name), words.makeRoom)
      : failure(words.brokeOff(path, megabytes(bytes)), words.tryAgain);
  }
  progress.done();
}

/** The bytes of a file, after checking the hash in the catalogue. */
async function checked(body: Response, sha256: string, set: PublicSet, path: string): Promise<ArrayBuffer> {
  const bytes = await body.arrayBuffer();
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  const found = Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
  if (found !== sha256) throw failure(words.changed(path), words.byHand(set.page));
  return bytes;
}

/** Progress of a download: by bytes if their number is known, otherwise by files. */
class DownloadProgress {
  private files = 0;
  private bytes = 0;

  constructor(
    private readonly set: PublicSet,
    private readonly options: CallOptions,
  ) {}

  arrived(bytes: number): void {
    this.bytes += bytes;
    this.tell();
  }

  /** Counts a finished file. */
  done(): void {
    this.files += 1;
    this.tell();
  }

  private tell(): void {
    const { name, files, bytes } = this.set;
    const label = words.arrived(name, this.files, files.length, megabytes(this.bytes));
    const fraction = bytes > 0 && files.length === 1 ? this.bytes / bytes : this.files / files.length;
    this.options.onProgress?.({ label, fraction: Math.min(1, fraction) });
  }
}

function failure(message: string, hint: string): StrutError {
  return new StrutError({ code: "bad-file", message, hint });
}
