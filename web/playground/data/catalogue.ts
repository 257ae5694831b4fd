/**
 * Public data sets that the page can fetch: what `catalog.json` says of them, and their download into the browser's
 * cache. What has arrived stays there, so that a download that was cancelled goes on where it was.
 */
import type { DroppedFile } from "../../worker/build/protocol";
import { type CallOptions, StrutError } from "../../worker/protocol";
import { megabytes } from "../numerals";
import { strings } from "../strings/strings";

const words = strings.data.sets;

/** A data set of the catalogue. */
export interface PublicSet {
  id: string;
  name: string;
  /** What is in it, in a few words. */
  about: string;
  licence: { name: string; url: string; note: string };
  citation: string;
  /** Where people read about it, and get it by hand. */
  page: string;
  /** Bytes in all; 0 if unknown. */
  bytes: number;
  /** What the files' addresses begin with. */
  base: string;
  /** Files or archives; one whose address does not end with its path has both. */
  files: (string | { path: string; url: string })[];
  /** Pattern of the clips' names, where they tell their labels. */
  pattern?: string;
  /** Table of labels (CSV), where the names tell nothing. */
  labels?: string;
}

/** Where files are kept: as much of a `Cache` as is needed here. */
export interface FileCache {
  match(url: string): Promise<Response | undefined>;
  put(url: string, response: Response): Promise<void>;
  delete(url: string): Promise<boolean>;
}

/** Files that are fetched at the same time. */
const AT_ONCE = 6;
const CACHE = "strut-sets";

/**
 * The sets of a catalogue.
 * @throws StrutError if it cannot be had
 */
export async function loadCatalogue(url: string | URL = "catalog.json"): Promise<PublicSet[]> {
  const response = await fetch(url).catch(() => undefined);
  const catalogue = response?.ok ? ((await response.json().catch(() => undefined)) as unknown) : undefined;
  const sets = (catalogue as { version?: number; sets?: PublicSet[] } | undefined)?.sets;
  if (!Array.isArray(sets)) throw failure(words.noList, "");
  return sets;
}

/** The browser's cache of sets. @throws StrutError where the browser offers none */
export async function openCache(): Promise<FileCache> {
  try {
    return await caches.open(CACHE);
  } catch {
    throw failure(words.noCache, words.dropHere);
  }
}

/** The set's files with their addresses. */
export function filesOf(set: PublicSet): { path: string; url: string }[] {
  return set.files.map((file) => {
    const { path, url } = typeof file === "string" ? { path: file, url: encodeURI(file) } : file;
    return { path, url: set.base + url };
  });
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

/**
 * Fetches what the cache lacks of a set and gives all of it, as if it had been dropped. What has arrived is kept if the
 * download fails or is cancelled.
 * @throws StrutError with what to do where that does not work
 */
export async function fetchSet(set: PublicSet, cache: FileCache, options: CallOptions = {}): Promise<DroppedFile[]> {
  const files = filesOf(set);
  const progress = new Progress(set, options);
  const missing: typeof files = [];
  for (const file of files) {
    const kept = await cache.match(file.url);
    if (kept) progress.done();
    else missing.push(file);
    void kept?.body?.cancel();
  }
  // The first that fails ends the others.
  const ending = new AbortController();
  const { signal } = ending;
  if (options.signal?.aborted) ending.abort();
  options.signal?.addEventListener("abort", () => ending.abort(), { once: true });
  const queue = missing.values();
  let failed: unknown;
  const work = async () => {
    for (const { path, url } of queue) {
      if (signal.aborted) return;
      await fetchFile(set, path, url, cache, signal, progress).catch((error) => {
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

async function fetchFile(
  set: PublicSet,
  path: string,
  url: string,
  cache: FileCache,
  signal: AbortSignal,
  progress: Progress,
): Promise<void> {
  const { host } = new URL(url, globalThis.location?.href);
  let response: Response;
  try {
    response = await fetch(url, { signal });
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
  try {
    // The cache takes the file as it arrives; one that breaks off is not kept.
    await cache.put(url, new Response(response.body.pipeThrough(counting)));
  } catch (error) {
    if (signal.aborted) throw error;
    throw (error as { name?: string }).name === "QuotaExceededError"
      ? failure(words.full(set.name), words.makeRoom)
      : failure(words.brokeOff(path, megabytes(bytes)), words.tryAgain);
  }
  progress.done();
}

/** How far a download is: by bytes where their number is known, else by files. */
class Progress {
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
