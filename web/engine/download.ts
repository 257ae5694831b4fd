/** Loads files of the site, in a browser and in Node. */
import { StrutError } from "./errors";

/**
 * Fetches a file through another thread, for files that this thread may not fetch.
 * @throws if that thread may not fetch it either
 */
type FetchElsewhere = (url: URL) => Promise<Response>;

let fetchElsewhere: FetchElsewhere | undefined;

/** Sets the fallback for files that this thread cannot fetch. */
export function setFetchElsewhere(fetch: FetchElsewhere): void {
  fetchElsewhere = fetch;
}

/** The bytes of a file on disk: Node only. */
export async function readFile(url: URL): Promise<Uint8Array<ArrayBuffer>> {
  // Built at run time so that bundlers do not resolve it.
  const name = ["node:fs", "promises"].join("/");
  const fs: typeof import("node:fs/promises") = await import(/* webpackIgnore: true */ /* @vite-ignore */ name);
  return new Uint8Array(await fs.readFile(url));
}

/**
 * The bytes of a file of the package: Node only.
 * @param what the part of Strut that the file is, for messages
 * @throws StrutError `load` if the file cannot be read
 */
export function readAsset(url: URL, what: string): Promise<Uint8Array<ArrayBuffer>> {
  return readFile(url).catch(() => {
    throw incomplete(what, `there is no file ${url.pathname}`);
  });
}

/**
 * A successful response of the server.
 * @param what the part of Strut that the file is, for messages
 * @throws StrutError `load` if there is none
 */
export async function download(url: URL, what: string): Promise<Response> {
  let response: Response;
  try {
    // These files are larger than the rest of the page. Low priority keeps the page from waiting for them.
    response = await fetch(url, { priority: "low" }).catch(
      (refused) => fetchElsewhere?.(url) ?? Promise.reject(refused),
    );
  } catch {
    throw unloadable(
      what,
      `the server cannot be reached for ${url.pathname}`,
      "Check the connection, then reload the page.",
    );
  }
  if (!response.ok) throw incomplete(what, `the server answered ${response.status} for ${url.pathname}`);
  return response;
}

/** The error for an incomplete file. */
export function incomplete(what: string, why: string): StrutError {
  return unloadable(what, why, "Reload the page; if that does not help, the site was not deployed completely.");
}

function unloadable(what: string, why: string, hint: string): StrutError {
  return new StrutError({ code: "load", message: `The ${what} could not be loaded: ${why}.`, hint });
}
