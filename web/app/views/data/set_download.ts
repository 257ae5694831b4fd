/**
 * Public data sets in the browser's cache: fetched, checked, and forgotten. What has arrived stays there, so that a
 * download that was cancelled goes on where it was.
 */
import type { DroppedFile } from "../../../client/build/protocol";
import { type CallOptions, StrutError } from "../../../client/protocol";
import { megabytes } from "../../strings/numerals";
import { strings } from "../../strings/strings";
import { filesOf, type PublicSet } from "./catalogue";

const words = strings.data.sets;

/** Where files are kept: as much of a `Cache` as is needed here. */
export interface FileCache {
  match(url: string): Promise<Response | undefined>;
  put(url: string, response: Response): Promise<void>;
  delete(url: string): Promise<boolean>;
  keys(): Promise<readonly { url: string }[]>;
}

/** Files that are fetched at the same time. */
const AT_ONCE = 6;
const CACHE = "strut-sets";

/** The browser's cache of sets. @throws StrutError where the browser offers none */
export async function openCache(): Promise<FileCache> {
  try {
    return await caches.open(CACHE);
  } catch {
    throw failure(words.noCache, words.dropHere);
  }
}

/** How many of the set's files the cache holds. */
export async function filesKept(set: PublicSet, cache: FileCache): Promise<number> {
  const found = await Promise.all(filesOf(set).map(({ url }) => cache.match(url)));
  for (const response of found) void response?.body?.cancel();
  return found.filter(Boolean).length;
}

/** Takes the set's files out of the cache. */
export async function forgetSet(set: PublicSet, cache: FileCache): Promise<void> {
  await Promise.all(filesOf(set).map(({ url }) => cache.delete(url)));
}

/** Takes out of the cache what no set names any more: nothing could use or delete it. */
export async function forgetUnlisted(sets: readonly PublicSet[], cache: FileCache): Promise<void> {
  const listed = new Set(sets.flatMap(filesOf).map(({ url }) => url));
  const unlisted = (await cache.keys()).filter(({ url }) => !listed.has(url));
  await Promise.all(unlisted.map(({ url }) => cache.delete(url)));
}

/**
 * Fetches what the cache lacks of a set and gives all of it, as if it had been dropped. What has arrived is kept if the
 * download fails or is cancelled.
 * @throws StrutError with what to do where that does not work
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

/** Fetches a file into the cache. One whose hash is known is kept only if it has that hash. */
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
    // Browsers do not tell a page why a request failed.
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
    // Without a hash the cache takes the file as it arrives; one that breaks off is not kept.
    await cache.put(url, sha256 === undefined ? body : new Response(await checked(body, sha256, set, path)));
  } catch (error) {
    if (signal.aborted || error instanceof StrutError) throw error;
    throw (error as { name?: string }).name === "QuotaExceededError"
      ? failure(words.full(set.name), words.makeRoom)
      : failure(words.brokeOff(path, megabytes(bytes)), words.tryAgain);
  }
  progress.done();
}

/** The bytes of a file, if they have the hash that the catalogue names. */
async function checked(body: Response, sha256: string, set: PublicSet, path: string): Promise<ArrayBuffer> {
  const bytes = await body.arrayBuffer();
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  const found = Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
  if (found !== sha256) throw failure(words.changed(path), words.byHand(set.page));
  return bytes;
}

/** How far a download is: by bytes where their number is known, else by files. */
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

  /** One more file is there. */
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
