/** The package on pages of others, installed from its tarball: bundled, by import map, from elsewhere, under policies. */
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build as esbuild } from "esbuild";
import type { Browser } from "playwright-core";
import { build as vite } from "vite";
import { afterAll, beforeAll, expect, test } from "vitest";
import { type Consumer, FRAMES, installPackage } from "../package/consumer";
import { serveFolder } from "../package/server";
import { launchBrowser } from "./browser";

/** What a page says of the walk that it styled. */
interface Said {
  thread: string;
  frames: number;
  bvh: string;
}

declare const window: { said: Promise<Said> };

let browser: Browser;
let consumer: Consumer;
let elsewhere: Awaited<ReturnType<typeof serveFolder>>;
beforeAll(async () => {
  consumer = installPackage();
  const installed = join(consumer.folder, "node_modules", "strut-motion");
  [browser, elsewhere] = await Promise.all([
    launchBrowser(),
    serveFolder(installed, { "Access-Control-Allow-Origin": "*" }),
  ]);
}, 900_000);
afterAll(async () => {
  await browser.close();
  await elsewhere.close();
  consumer.remove();
});

/** A page's script; `specifier` is where it has the package from. */
const script = (specifier = "strut-motion", options = "") => `import { loadStrut } from ${JSON.stringify(specifier)};
window.said = (async () => {
  const strut = await loadStrut(${options});
  const db = await strut.openDatabase("/demo.strutdb");
  const motion = await strut.openMotion("/walk.bvh");
  const styled = await strut.stylize(motion, db, { styles: { proud: 1 } });
  strut.dispose();
  return { thread: strut.thread, frames: motion.frames, bvh: styled.toBVH() };
})();
window.said.catch(() => {});
`;

const importMap = (address: string) =>
  `<script type="importmap">{ "imports": { "strut-motion": "${address}" } }</script>`;

const page = (head: string, body: string) => `<!doctype html><meta charset="utf-8">${head}${body}`;

/** Writes a page with its files into a folder of its own. */
function site(name: string, files: Readonly<Record<string, string>>): string {
  const folder = join(consumer.folder, name);
  mkdirSync(folder, { recursive: true });
  for (const file of ["demo.strutdb", "walk.bvh"]) cpSync(join(consumer.folder, file), join(folder, file));
  for (const [file, text] of Object.entries(files)) writeFileSync(join(folder, file), text);
  return folder;
}

/** Opens a site, other hosts but its own and `elsewhere` blocked, and waits for what it says. */
async function open(folder: string, headers?: Readonly<Record<string, string>>): Promise<Said> {
  const server = await serveFolder(folder, headers);
  const context = await browser.newContext();
  try {
    const allowed = [server.url, elsewhere.url];
    await context.route("**", (route) =>
      allowed.some((url) => route.request().url().startsWith(url)) ? route.continue() : route.abort(),
    );
    const tab = await context.newPage();
    await tab.goto(server.url);
    await tab.waitForFunction(() => window.said !== undefined);
    return await tab.evaluate(() => window.said);
  } finally {
    await context.close();
    await server.close();
  }
}

/** Expects what the command writes. The files are too long for a report of how they differ. */
function expectSame({ bvh, ...said }: Said, thread: string): void {
  expect({ ...said, same: bvh === consumer.byCommand }).toEqual({ thread, frames: FRAMES, same: true });
}

test("by import map, with no build", async () => {
  const folder = site("import-map", {
    "index.html": page(importMap("./strut-motion/index.js"), '<script type="module" src="main.js"></script>'),
    "main.js": script(),
  });
  cpSync(join(consumer.folder, "node_modules", "strut-motion"), join(folder, "strut-motion"), { recursive: true });
  expectSame(await open(folder), "worker");
});

test("built by Vite without configuration", async () => {
  const folder = site("vite", {
    "index.html": page("", '<script type="module" src="/main.js"></script>'),
    "main.js": script(),
  });
  const dist = join(folder, "dist");
  await vite({ root: folder, configFile: false, logLevel: "error", build: { outDir: dist } });
  for (const file of ["demo.strutdb", "walk.bvh"]) cpSync(join(folder, file), join(dist, file));
  expectSame(await open(dist), "worker");
});

test("bundled by esbuild, the assets copied beside the bundle", async () => {
  const folder = site("esbuild", {
    "index.html": page("", '<script type="module" src="bundle.js"></script>'),
    "main.js": script(),
  });
  await esbuild({
    entryPoints: [join(folder, "main.js")],
    outfile: join(folder, "bundle.js"),
    bundle: true,
    format: "esm",
    logLevel: "error",
  });
  cpSync(join(consumer.folder, "node_modules", "strut-motion", "assets"), join(folder, "assets"), { recursive: true });
  expectSame(await open(folder), "worker");
});

test("from another origin that allows it, in a worker from a blob", async () => {
  const folder = site("elsewhere", {
    "index.html": page(importMap(`${elsewhere.url}/index.js`), '<script type="module" src="main.js"></script>'),
    "main.js": script(),
  });
  expectSame(await open(folder), "blob");
});

test("in one file, imported from a blob", async () => {
  const folder = site("inline", {
    "index.html": page("", '<script type="module" src="main.js"></script>'),
    "main.js": `const text = await (await fetch("/inline.js")).text();
const source = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
await import(URL.createObjectURL(new Blob([${JSON.stringify(script("SOURCE"))}.replace("SOURCE", source)], { type: "text/javascript" })));
`,
  });
  cpSync(join(consumer.folder, "node_modules", "strut-motion", "inline.js"), join(folder, "inline.js"));
  expectSame(await open(folder), "blob");
});

test("on the page's thread where it may have no worker", async () => {
  const folder = site("no-worker", {
    "index.html": page(importMap("./strut-motion/index.js"), '<script type="module" src="main.js"></script>'),
    "main.js": script("strut-motion", "{ worker: false }"),
  });
  cpSync(join(consumer.folder, "node_modules", "strut-motion"), join(folder, "strut-motion"), { recursive: true });
  expectSame(await open(folder), "page");
});

test("under a Content-Security-Policy and with Trusted Types", async () => {
  const folder = site("policy", {
    "index.html": page("", '<script type="module" src="main.js"></script>'),
    "main.js": script("./strut-motion/index.js"),
  });
  cpSync(join(consumer.folder, "node_modules", "strut-motion"), join(folder, "strut-motion"), { recursive: true });
  const policy = [
    "default-src 'none'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "worker-src 'self'",
    "connect-src 'self'",
    "trusted-types strut-motion",
    "require-trusted-types-for 'script'",
  ].join("; ");
  expectSame(await open(folder, { "Content-Security-Policy": policy }), "worker");
  // The same page, but workers are forbidden altogether.
  const none = policy.replace("worker-src 'self'", "worker-src 'none'");
  expectSame(await open(folder, { "Content-Security-Policy": none }), "page");
});

test("a missing file is a sentence with a hint", async () => {
  const folder = site("missing", {
    "index.html": page(importMap("./strut-motion/index.js"), '<script type="module" src="main.js"></script>'),
    "main.js": script(),
  });
  cpSync(join(consumer.folder, "node_modules", "strut-motion"), join(folder, "strut-motion"), {
    recursive: true,
    filter: (path) => !path.endsWith(".wasm"),
  });
  await expect(open(folder)).rejects.toThrow(/The engine could not be loaded: the server answered 404/);
});
