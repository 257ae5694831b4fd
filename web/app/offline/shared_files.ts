/** Files that another app shares with the installed page: the service worker receives them, and the page takes them. */

/** Where they are sent to, from the folder of the site: the `share_target` of `public/manifest.webmanifest`. */
export const SHARE_PATH = "shared";
/** The query of the page that is opened with them. */
export const SHARED_QUERY = "?shared";

const cacheOf = (folder: string): string => `strut-shared-${folder}`;

/** Whether a request comes from the browser itself, as of another app that shares files, or from this site: not from any page. */
export function isOfThisSite(request: Request): boolean {
  const site = request.headers.get("Sec-Fetch-Site");
  return site === null || site === "none" || site === "same-origin";
}

/** Stores the files of a form, and answers with the page that takes them. */
export async function receiveShared(request: Request, folder: string): Promise<Response> {
  const files = (await request.formData()).getAll("files").filter((value) => value instanceof File);
  const cache = await caches.open(cacheOf(folder));
  const store = (file: File, i: number) =>
    cache.put(`${folder}${SHARE_PATH}/${i}/${encodeURIComponent(file.name)}`, new Response(file));
  await Promise.all(files.map(store));
  return Response.redirect(folder + SHARED_QUERY, 303);
}

/** Takes the files out of the store. */
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
