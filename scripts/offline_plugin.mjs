// The service worker of the site, dist/service_worker.js, with the list of the files that it caches.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { build } from "esbuild";
import { siteFiles } from "./site_files.mjs";
import { root } from "./steps.mjs";

/** Writes the worker into the folder of a built site. */
export async function writeServiceWorker(dist) {
  const { first, rest } = siteFiles(dist);
  const entries = (files) => files.map((file) => entryOf(dist, file));
  const files = { first: entries(["index.html", ...first]), rest: entries([...rest, "catalog.json"]) };
  await build({
    entryPoints: [join(root, "web", "app", "offline", "service_worker.ts")],
    outfile: join(dist, "service_worker.js"),
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    legalComments: "none",
    define: { "process.env.NODE_ENV": '"production"', FILES: JSON.stringify(files) },
    logLevel: "warning",
  });
}

/** Returns a file's entry for Workbox. The name of an asset changes with its content, that of another file does not. */
function entryOf(dist, url) {
  const digest = createHash("sha256")
    .update(readFileSync(join(dist, url)))
    .digest("base64");
  return { url, revision: url.startsWith("assets/") ? null : digest, integrity: `sha256-${digest}` };
}

/** Vite's plugin: adds the service worker to a built site. */
export function offlinePlugin() {
  let dist;
  return {
    name: "strut-offline",
    apply: "build",
    configResolved({ root: pages, build: { outDir } }) {
      dist = resolve(pages, outDir);
    },
    writeBundle: () => writeServiceWorker(dist),
  };
}
