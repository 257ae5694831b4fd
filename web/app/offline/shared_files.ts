/** Files that another app shares with the installed page: the service worker receives them, and the page opens them. */

/** The path to which they are sent, relative to the site's folder: the `share_target` of `public/manifest.webmanifest`. */
export const SHARE_PATH = "shared";
/** The query of the page that is opened with them. */
export const SHARED_QUERY = "?shared";

const cacheOf = (folder: string): string => `strut-shared-${folder}`;

/**
 * Whether a request comes from the browser itself, as when another app shares files, or from this site, but not from
 * another site's page.
 */
export function isOfThisSite(request: Request): boolean {
  const site = request.headers.get("Sec-Fetch-Site");
  return site === null || site === "none" || site === "same-origin";
}

/** Stores the files of a form, and responds with the page that opens them. */
export async function receiveShared(request: Request, folder: string): Promise<Response> {
  const files = (await request.formData()).getAll("files").filter((value) => value instanceof File);
  const cache = await caches.open(cacheOf(folder));
  const store = (file: File, i: number) =>
    cache.put(`${folder}${SHARE_PATH}/${i}/${encodeURIComponent(file.name)}`, new Response(file));
  await Promise.all(files.map(store));
  return Response.redirect(folder + SHARED_QUERY, 303);
}

/** Returns the stored files and removes them from the store. */
export async function takeShared(folder: string): Promise<File[]> {
  const name = cacheOf(folder);
  const cache = await caches.open(name);
  const files = await Promise.all((await cache.keys()).map((key) => storedFile(cache, key)));
  await caches.delete(name);
  return files;
}

async function storedFile(cache: Cache, key: Request): Promise<File> {
  const name = decodeURIComponent(key.url.slice(key.url.lastIndexOf("/") + 1));
  return new File([await (await cache.match(key))!.blob()], name);
}
