/** Pages of somebody who installed the package: what they run, how they are opened, and what must come of it. */
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import type { Browser } from "playwright-core";
import { type Consumer, FRAMES } from "./consumer";

/** What a page says of the walk that it styled. */
export interface Said {
  /** `Strut.thread`. */
  thread: string;
  /** Frames of the input. */
  frames: number;
  /** The styled walk. */
  bvh: string;
}

/** What a page said, and what it and its workers loaded for that. */
export interface Visit {
  said: Said;
  urls: string[];
}

/** Files that every page fetches beside itself. */
const DATA = ["demo.strutdb", "walk.bvh"];

declare const window: { said: Promise<Said> };

/**
 * The module of a page.
 * @param specifier where it has the package from
 * @param options of `loadStrut`, as text
 */
export const program = (specifier = "strut-motion", options = "") => `import { loadStrut } from "${specifier}";
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

/** A page that runs a module, which may have the package by import map. */
export const html = (main: string, importsFrom?: string) =>
  `<!doctype html><meta charset="utf-8"><title>Consumer</title>${
    importsFrom === undefined
      ? ""
      : `<script type="importmap">{ "imports": { "strut-motion": "${importsFrom}" } }</script>`
  }<script type="module" src="${main}"></script>`;

/** Copies what every page fetches. */
export function copyData(consumer: Consumer, folder: string): void {
  mkdirSync(folder, { recursive: true });
  for (const file of DATA) cpSync(join(consumer.folder, file), join(folder, file));
}

/** Writes files into a folder of the consumer's, with what every page fetches. */
export function writeSite(consumer: Consumer, name: string, files: Readonly<Record<string, string>>): string {
  const folder = join(consumer.folder, name);
  copyData(consumer, folder);
  for (const [file, text] of Object.entries(files)) writeFileSync(join(folder, file), text);
  return folder;
}

/**
 * Copies the installed package beside a page.
 * @param without the ending of files that are left out
 */
export function copyPackage(consumer: Consumer, folder: string, without?: string): void {
  cpSync(consumer.installed, join(folder, "strut-motion"), {
    recursive: true,
    filter: (path) => without === undefined || !path.endsWith(without),
  });
}

/**
 * Opens a page, all hosts but those named blocked, and waits for what it says.
 * @param allowed other hosts that it may reach
 * @param inFrame whether its first frame says it
 */
export async function visitPage(
  browser: Browser,
  url: string,
  { allowed = [], inFrame = false }: { allowed?: readonly string[]; inFrame?: boolean } = {},
): Promise<Visit> {
  const context = await browser.newContext();
  const urls = new Set<string>();
  try {
    await context.route("**", (route) => {
      const address = route.request().url();
      if (![url, ...allowed].some((host) => address.startsWith(new URL(host).origin))) return route.abort();
      urls.add(address);
      return route.continue();
    });
    const tab = await context.newPage();
    await tab.goto(url);
    const speaker = inFrame ? tab.frames()[1]! : tab;
    await speaker.waitForFunction(() => window.said !== undefined);
    return { said: await speaker.evaluate(() => window.said), urls: [...urls] };
  } finally {
    await context.close();
  }
}

/** Kilobytes after gzip of what was loaded, but for the data that it styled. */
export async function loadedKb(urls: readonly string[]): Promise<number> {
  const loaded = urls.filter((url) => !DATA.some((file) => url.endsWith(`/${file}`)));
  const bodies = await Promise.all(loaded.map(async (url) => (await fetch(url)).arrayBuffer()));
  return bodies.reduce((sum, body) => sum + gzipSync(body).length, 0) / 1000;
}

/** What a page must say. The files are too long for a report of how they differ. */
export const expected = (thread: string) => ({ thread, frames: FRAMES, same: true });

/** What it said, in the same form. */
export const summary = ({ bvh, ...said }: Said, consumer: Consumer) => ({ ...said, same: bvh === consumer.byCommand });
