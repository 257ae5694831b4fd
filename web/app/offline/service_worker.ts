/**
 * Stores the site in the browser, so that it works without a network: the files of the first view when the worker is
 * installed, the others when a page requests it. `scripts/offline_plugin.mjs` bundles it and lists the files.
 *
 * Versions do not mix. A page and everything that it loads later come from the list of one worker. The worker of a
 * newer build waits until no page is open, or until the user requests the update.
 */
import { PrecacheController } from "workbox-precaching/PrecacheController.js";
import type { Order } from "./orders";
import { receiveShared, SHARE_PATH } from "./shared_files";

declare const self: ServiceWorkerGlobalScope;

/** The files by their paths relative to the worker, each with its digest; the build replaces this name by them. */
declare const FILES: Record<"first" | "rest", Parameters<PrecacheController["addToCacheList"]>[0]>;

const { scope } = self.registration;
/** The URL of a path of the site. */
const at = (path: string): string => new URL(path, scope).href;

const first = keeperOf("first");
const rest = keeperOf("rest");

/** Stores some of the files in a cache of their own. Damaged files are fetched again. */
function keeperOf(part: keyof typeof FILES): PrecacheController {
  const keeper: PrecacheController = new PrecacheController({
    cacheName: `strut-${part}-${scope}`,
    plugins: [
      {
        cachedResponseWillBeUsed: async ({ request, cachedResponse, state }) => {
          if (!cachedResponse) return undefined;
          const whole = (await integrityOf(cachedResponse.clone())) === keeper.getIntegrityForCacheKey(request.url);
          if (!whole) state!.damaged = true;
          return whole ? cachedResponse : undefined;
        },
        // The damage may come from the browser's own cache.
        requestWillFetch: async ({ request, state }) =>
          state!.damaged ? new Request(request, { cache: "reload" }) : request,
      },
    ],
  });
  keeper.addToCacheList(FILES[part]);
  return keeper;
}

async function integrityOf(response: Response): Promise<string> {
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", await response.arrayBuffer()));
  return `sha256-${btoa(String.fromCharCode(...digest))}`;
}

/** A file of this version, from the cache or fetched into it; `undefined` if the version has none with this URL. */
function keptFile(url: string, event: ExtendableEvent): Promise<Response> | undefined {
  for (const keeper of [first, rest]) {
    const cacheKey = keeper.getCacheKeyForURL(url);
    if (cacheKey === undefined) continue;
    const integrity = keeper.getIntegrityForCacheKey(cacheKey);
    return keeper.strategy.handle({ event, request: new Request(url), params: { cacheKey, integrity } });
  }
  return undefined;
}

/** The response to a request of the app; other pages of the site and other hosts are left to the network. */
function answerTo(event: FetchEvent): Promise<Response> | undefined {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  const url = origin + pathname;
  if (request.method === "POST") return url === at(SHARE_PATH) ? receiveShared(request, scope) : undefined;
  if (request.method !== "GET") return undefined;
  if (request.mode === "navigate") return url === scope || url === at("index.html") ? page(event) : undefined;
  // The network may work: it has a newer version if this one cannot be repaired.
  const kept = keptFile(request.url, event)?.catch(() => fetch(request));
  return kept ?? (url.startsWith(at("assets/")) ? olderFile(request) : undefined);
}

/** The app's page, regardless of the query. */
function page(event: FetchEvent): Promise<Response> {
  return keptFile(at("index.html"), event)!.catch(() => fetch(event.request));
}

/** A file of an older version for a page that is still open: see {@link dropOlder}. */
async function olderFile(request: Request): Promise<Response> {
  return (await caches.match(request.url, { ignoreVary: true })) ?? fetch(request);
}

/** Fetches missing or damaged files. Files that cannot be fetched now are fetched with the next page. */
async function keepAll(event: ExtendableEvent): Promise<void> {
  for (const keeper of [first, rest])
    for (const url of keeper.getCachedURLs()) await keptFile(url, event)?.catch(() => {});
}

/** Deletes the files of older versions, unless other open pages may still need them: then the next version does. */
async function dropOlder(event: ExtendableEvent): Promise<void> {
  const pages = await self.clients.matchAll({ type: "window" });
  if (pages.length > 1) return;
  await first.activate(event);
  await rest.activate(event);
}

const ORDERS: Record<Order, (event: ExtendableEvent) => Promise<void>> = {
  "take over": () => self.skipWaiting(),
  "keep all": keepAll,
};

self.addEventListener("install", first.install);
self.addEventListener("activate", (event) => event.waitUntil(Promise.all([self.clients.claim(), dropOlder(event)])));
self.addEventListener("message", (event) => event.waitUntil(ORDERS[event.data as Order](event)));
self.addEventListener("fetch", (event) => {
  const answer = answerTo(event);
  if (answer) event.respondWith(answer);
});
