/** Files that another app shares with the installed page: the service worker receives them, and the page opens them. */

/** The path to which they are sent, relative to the site's folder: the `share_target` of `public/manifest.webmanifest`. */
export const SHARE_PATH = "shared";
/** The query of the page that is opened with them. */
export const SHARED_QUERY = "?shared";

const cacheOf = (folder: string): string => `strut-shared-${folder}`;

/**
 * Stores the files of a form, in place of those of an earlier form, and responds with the page that opens them. Any
 * page of the web can send such a form. A service worker does not see `Sec-Fetch-Site`, so it cannot tell the sender.
 */
export async function receiveShared(request: Request, folder: string): Promise<Response> {
  const files = (await request.formData()).getAll("files").filter((value) => value instanceof File);
  await caches.delete(cacheOf(folder));
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
