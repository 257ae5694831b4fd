/** Sources of databases and motions: URLs, texts, bytes and files, in a browser and in Node. */
import { readFile } from "../engine/download";
import { cancelled, StrutError } from "../engine/errors";
import { baseAddress } from "./assets";
import type { Source } from "./types";

/** The contents of a file. */
export interface SourceFile {
  /** Its name without folders and extension; empty if it has none. */
  name: string;
  bytes: ArrayBuffer;
}

/** The name after `strut:`, or `undefined` for other sources. */
export function builtInName(source: Source): string | undefined {
  return typeof source === "string" && source.startsWith("strut:") ? source.slice("strut:".length) : undefined;
}

/**
 * Reads a source.
 * @param what noun for messages
 * @throws StrutError `load` if a URL cannot be read, `bad-input` if it is not a URL, `cancelled`
 */
export async function readSource(source: Source, what: string, signal?: AbortSignal): Promise<SourceFile> {
  if (signal?.aborted) throw cancelled(signal.reason);
  // Objects from a frame have other classes than this page's.
  if (tagOf(source) === "ArrayBuffer") return { name: "", bytes: source as ArrayBuffer };
  if (ArrayBuffer.isView(source)) return { name: "", bytes: source.slice().buffer };
  if (isBlob(source)) {
    const name = "name" in source && typeof source.name === "string" ? source.name : "";
    return { name: nameOf(name), bytes: await source.arrayBuffer() };
  }
  if (typeof source === "string" && isText(source)) return { name: "", bytes: bytesOf(source) };
  if (!isAddress(source)) throw noSource(what, tagOf(source));
  const url = urlOf(source, what);
  const path = url.protocol === "data:" ? "" : decoded(url.pathname);
  return { name: nameOf(path), bytes: await fetched(url, what, signal) };
}

/** A percent-decoded path; unchanged if a percent sign in it is literal. */
function decoded(path: string): string {
  try {
    return decodeURIComponent(path);
  } catch {
    return path;
  }
}

/** The tag of a value's class, the same for all pages and frames. */
const tagOf = (value: unknown): string => Object.prototype.toString.call(value).slice("[object ".length, -1);

const isAddress = (source: Source): source is string | URL => typeof source === "string" || tagOf(source) === "URL";

const isBlob = (source: Source): source is Blob => /^(Blob|File)$/.test(tagOf(source));

const HINT = "Pass a URL, a file, its text or its bytes.";

function noSource(what: string, found: string): StrutError {
  return new StrutError({ code: "bad-input", message: `The ${what} cannot be ${found}.`, hint: HINT });
}

/** A BVH file is text with several lines, unlike a URL. */
const isText = (source: string): boolean => /^\s*HIERARCHY\b/i.test(source) || source.includes("\n");

function bytesOf(text: string): ArrayBuffer {
  return new TextEncoder().encode(text).buffer as ArrayBuffer;
}

const nameOf = (path: string): string => path.slice(path.lastIndexOf("/") + 1).replace(/\.\w+$/, "");

/** Relative URLs are relative to the page or the worker, or in Node to the working directory. */
function urlOf(source: string | URL, what: string): URL {
  const base = typeof location === "object" ? baseAddress() : folderOfNode();
  try {
    return new URL(source, base);
  } catch (cause) {
    const message = `The ${what} '${source}' is not a URL.`;
    throw new StrutError({ code: "bad-input", message, hint: HINT }, cause);
  }
}

function folderOfNode(): string | undefined {
  return typeof process === "object" ? `file://${encodeURI(process.cwd())}/` : undefined;
}

async function fetched(url: URL, what: string, signal: AbortSignal | undefined): Promise<ArrayBuffer> {
  if (url.protocol === "file:" && typeof process === "object") {
    return (await readFile(url).catch((cause) => unreadable(url, what, "there is no such file", cause))).buffer;
  }
  try {
    const response = await fetch(url, { signal: signal ?? null });
    if (!response.ok) return unreadable(url, what, `the server answered ${response.status}`);
    return await response.arrayBuffer();
  } catch (cause) {
    if (signal?.aborted) throw cancelled(signal.reason);
    if (cause instanceof StrutError) throw cause;
    return unreadable(url, what, "the server cannot be reached, or does not allow this page to read it (CORS)", cause);
  }
}

function unreadable(url: URL, what: string, why: string, cause?: unknown): never {
  const message = `The ${what} ${url.href} could not be loaded: ${why}.`;
  throw new StrutError({ code: "load", message, hint: "Check the URL." }, cause);
}
