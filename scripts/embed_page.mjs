// The pages for iframes: dist/embed.html with a player, dist/figure.html with a figure of a lesson and, if the site's
// address is known, a page with oEmbed discovery for each preset.
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "./steps.mjs";

const SOURCE = join(root, "web", "embed");

/** Size of a preset's iframe, pixels. */
const SIZE = { width: 688, height: 342 };
/** Permissions of an iframe: it may run its own scripts and save files on request, and has no storage. */
const SANDBOX = "allow-scripts allow-same-origin allow-downloads";

/** Writes the pages into the folder of the built page. `site` is its absolute address, or empty. */
export async function writeEmbedPage({ site = process.env.STRUT_SITE_URL ?? "", dist = join(root, "dist") } = {}) {
  // A clean checkout installs it only after this file is read.
  const { build } = await import("esbuild");
  mkdirSync(join(dist, "embed"), { recursive: true });
  for (const page of ["embed.html", "figure.html"]) cpSync(join(SOURCE, page), join(dist, page));
  cpSync(join(SOURCE, "embed.css"), join(dist, "embed", "embed.css"));
  await build({
    entryPoints: [join(SOURCE, "embed.ts"), join(SOURCE, "figure.ts")],
    outdir: join(dist, "embed"),
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    logLevel: "warning",
  });
  if (site) for (const preset of presets()) writePreset(dist, new URL(site), preset);
}

/** Returns the figures with separate pages. */
export function presets() {
  return JSON.parse(readFileSync(join(SOURCE, "presets.json"), "utf8"));
}

/** https://oembed.com: addresses must be absolute. */
function writePreset(dist, site, { name, title, parameters }) {
  const folder = join(dist, "embed", name);
  mkdirSync(folder, { recursive: true });
  const at = (path) => new URL(path, site).href;
  const frame = `${at("embed.html")}?${new URLSearchParams(parameters)}`;
  const html = `<iframe src="${escaped(frame)}" title="${escaped(title)}" width="${SIZE.width}" height="${SIZE.height}" loading="lazy" sandbox="${SANDBOX}" allow="fullscreen" style="border:0;max-width:100%"></iframe>`;
  const poster = join(SOURCE, "posters", `${name}.png`);
  cpSync(poster, join(folder, "poster.png"));
  const { width, height } = pngSize(readFileSync(poster));
  const answer = {
    version: "1.0",
    type: "rich",
    title,
    provider_name: "Strut",
    provider_url: at(""),
    html,
    ...SIZE,
    thumbnail_url: at(`embed/${name}/poster.png`),
    thumbnail_width: width,
    thumbnail_height: height,
  };
  writeFileSync(join(folder, "oembed.json"), `${JSON.stringify(answer, null, 2)}\n`);
  writeFileSync(
    join(folder, "index.html"),
    `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>${escaped(title)} · Strut</title>
<meta property="og:title" content="${escaped(title)}">
<meta property="og:image" content="${at(`embed/${name}/poster.png`)}">
<link rel="alternate" type="application/json+oembed" href="${at(`embed/${name}/oembed.json`)}" title="${escaped(title)}">
<style>html,body,iframe{height:100%;width:100%;margin:0;border:0}</style>
</head>
<body>${html.replace(/ width="\d+" height="\d+"/, "").replace('style="border:0;max-width:100%"', "")}</body>
</html>
`,
  );
}

const escaped = (text) =>
  text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

/** Returns width and height of a PNG, from its first chunk. */
function pngSize(bytes) {
  return { width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20) };
}
