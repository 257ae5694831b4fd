/** Pages of a user of the package: their programs, how they are opened, and their expected results. */
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import type { Browser } from "playwright-core";
import { type Consumer, FRAMES } from "./consumer";

/** Result of a page that styled the walk. */
export interface Said {
  /** `Strut.thread`. */
  thread: string;
  /** Frames of the input. */
  frames: number;
  /** The styled walk. */
  bvh: string;
}

/** Result of a page, and the files that it and its workers loaded. */
export interface Visit {
  said: Said;
  urls: string[];
}

/** Data files that every page fetches. */
const DATA = ["demo.strutdb", "walk.bvh"];

declare const window: { said: Promise<Said> };

/**
 * Returns the module of a page.
 * @param specifier specifier of the package
 * @param options options of `loadStrut`, as text
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

/** Returns a page that runs a module, which may import the package by import map. */
export const html = (main: string, importsFrom?: string) =>
  `<!doctype html><meta charset="utf-8"><title>Consumer</title>${
    importsFrom === undefined
      ? ""
      : `<script type="importmap">{ "imports": { "strut-motion": "${importsFrom}" } }</script>`
  }<script type="module" src="${main}"></script>`;

/** Copies the data files that every page fetches. */
export function copyData(consumer: Consumer, folder: string): void {
  mkdirSync(folder, { recursive: true });
  for (const file of DATA) cpSync(join(consumer.folder, file), join(folder, file));
}

/** Writes files into a folder of the consumer's, with the data files. */
export function writeSite(consumer: Consumer, name: string, files: Readonly<Record<string, string>>): string {
  const folder = join(consumer.folder, name);
  copyData(consumer, folder);
  for (const [file, text] of Object.entries(files)) writeFileSync(join(folder, file), text);
  return folder;
}

/**
 * Copies the installed package next to a page.
 * @param without the ending of files that are omitted
 */
export function copyPackage(consumer: Consumer, folder: string, without?: string): void {
  cpSync(consumer.installed, join(folder, "strut-motion"), {
    recursive: true,
    filter: (path) => without === undefined || !path.endsWith(without),
  });
}

/**
 * Opens a page, with all hosts blocked except those named, and waits for its result.
 * @param allowed other hosts that it may reach
 * @param inFrame whether its first iframe returns the result
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

/** Returns kilobytes of the loaded files after gzip, without the data. */
export async function loadedKb(urls: readonly string[]): Promise<number> {
  const loaded = urls.filter((url) => !DATA.some((file) => url.endsWith(`/${file}`)));
  const bodies = await Promise.all(loaded.map(async (url) => (await fetch(url)).arrayBuffer()));
  return bodies.reduce((sum, body) => sum + gzipSync(body).length, 0) / 1000;
}

/** Returns the expected result of a page. The BVH texts are only compared, because they are too long for a report. */
export const expected = (thread: string) => ({ thread, frames: FRAMES, same: true });

/** Returns the result of a page in the same form. */
export const summary = ({ bvh, ...said }: Said, consumer: Consumer) => ({ ...said, same: bvh === consumer.byCommand });
