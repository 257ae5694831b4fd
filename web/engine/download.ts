/** Files of the site, in a browser and in Node. */
import { StrutError } from "./errors";

/** Has a file that this thread may not fetch from another thread. @throws where that may not either */
export type FetchElsewhere = (url: URL) => Promise<Response>;

let fetchElsewhere: FetchElsewhere | undefined;

/** Says what is asked on this thread for files that it cannot fetch. */
export function setFetchElsewhere(fetch: FetchElsewhere): void {
  fetchElsewhere = fetch;
}

/** The bytes of a file on disk: Node only. */
export async function readFile(url: URL): Promise<Uint8Array<ArrayBuffer>> {
  // No bundler may look for it.
  const name = ["node:fs", "promises"].join("/");
  const fs: typeof import("node:fs/promises") = await import(/* webpackIgnore: true */ /* @vite-ignore */ name);
  return new Uint8Array(await fs.readFile(url));
}

/**
 * The bytes of a file of the package: Node only.
 * @param what the part of Strut that the file is, for messages
 * @throws StrutError `load` if there is none
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
    // These files are larger than all of a page, which must not wait for them.
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

/** The error of a file that is not whole. */
export function incomplete(what: string, why: string): StrutError {
  return unloadable(what, why, "Reload the page; if that does not help, the site was not deployed completely.");
}

function unloadable(what: string, why: string, hint: string): StrutError {
  return new StrutError({ code: "load", message: `The ${what} could not be loaded: ${why}.`, hint });
}
