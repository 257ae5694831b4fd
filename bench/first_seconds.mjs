// The first seconds of the page on slow 4G, as a film: what is visible when, and what was loaded until then.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { root, Sentence } from "../scripts/steps.mjs";
import { launchWithoutCard, requireBuiltSite } from "./built_site.mjs";
import { serveCompressed } from "./hosted_site.mjs";

/** Lighthouse's slow 4G: 1.6 Mbit/s, 150 ms. */
export const SLOW_4G = { bytesPerSec: 200_000, latencyMs: 150 };
/** Files that no visitor of the page loads, and the service worker, which caches files after the first seconds. */
const OTHERS = /^(package|embed)\/|bench|service_worker/;

/** The page's own marks (`MARKS` of web/player/playback.ts). */
const MARKS = { character: "strut: first frame", styled: "strut: first styled frame" };

/** Runs in the page: returns the time of a mark, milliseconds, or undefined before it. */
const timeOf = (mark) => performance.getEntriesByName(mark)[0]?.startTime;

/**
 * Films the first `secs` seconds.
 * @param folder folder of the pictures, named by their time, milliseconds; no pictures are written without it
 * @param line as for `serveCompressed`; null for the machine's own speed
 * @returns milliseconds to the first character and to the first styled frame, and the gzipped bytes that were sent
 * before that
 */
export async function filmFirstSeconds({ folder, secs = 5, line = SLOW_4G, viewport = { width: 412, height: 823 } }) {
  requireBuiltSite();
  const site = await serveCompressed(join(root, "dist"), (path) => !OTHERS.test(path), line);
  const browser = await launchWithoutCard();
  try {
    const page = await (await browser.newContext({ viewport, serviceWorkers: "block" })).newPage();
    const session = await page.context().newCDPSession(page);
    const start = Date.now();
    if (folder) {
      mkdirSync(folder, { recursive: true });
      session.on("Page.screencastFrame", ({ data, metadata, sessionId }) => {
        const ms = Math.round(1000 * metadata.timestamp - start);
        writeFileSync(join(folder, `${String(ms).padStart(5, "0")}.png`), Buffer.from(data, "base64"));
        session.send("Page.screencastFrameAck", { sessionId }).catch(() => {});
      });
      await session.send("Page.startScreencast", { format: "png", everyNthFrame: 1 });
    }
    await page.goto(site.url, { waitUntil: "commit" });
    const began = Date.now();
    await page.waitForTimeout(Math.max(0, 1000 * secs - (began - start)));
    await page.waitForFunction(timeOf, MARKS.styled, { timeout: 60_000 });
    const [character, styled] = await Promise.all([
      page.evaluate(timeOf, MARKS.character),
      page.evaluate(timeOf, MARKS.styled),
    ]);
    const origin = await page.evaluate(() => performance.timeOrigin);
    const before = site.sent.filter(({ time }) => time < origin + styled);
    const bytes = before.reduce((sum, { path }) => sum + gzipBytes(path), 0);
    return { character_ms: Math.round(character), styled_ms: Math.round(styled), gzip_bytes: bytes };
  } finally {
    await browser.close();
    await site.close();
  }
}

/** Returns the size of a file of the site after gzip; files that do not become smaller are sent uncompressed. */
function gzipBytes(path) {
  const bytes = readFileSync(join(root, "dist", path === "/" ? "index.html" : path));
  return Math.min(bytes.length, gzipSync(bytes, { level: 9 }).length);
}

/**
 * Goals (issue 23): time of the first styled frame on slow 4G and at the machine's own speed, and the bytes before it.
 */
const MOST = { slowMs: 4000, localMs: 1200, bytes: 600_000 };
/** Number of visits at the machine's own speed; their median counts. */
const VISITS = 5;

/** Measures the first seconds on slow 4G, filmed if `folder` is given, and at the machine's own speed. */
export async function measureFirstSeconds(folder) {
  const slow = await filmFirstSeconds({ folder });
  const visits = [];
  for (let i = 0; i < VISITS; i++) visits.push(await filmFirstSeconds({ secs: 0, line: null }));
  const local = visits.toSorted((a, b) => a.styled_ms - b.styled_ms)[VISITS >> 1];
  return { slow_4g: slow, local };
}

/** Returns the lines that show the result of {@link measureFirstSeconds}. */
export function linesOfSeconds({ slow_4g: slow, local }) {
  const times = ({ character_ms, styled_ms }, most) =>
    `a walker after ${character_ms} ms, styled ${styled_ms} of ${most} ms`;
  return [
    `  ${"slow 4G".padEnd(24)} ${times(slow, MOST.slowMs)}`,
    `  ${"this machine".padEnd(24)} ${times(local, MOST.localMs)}`,
    `  ${"before it is styled".padEnd(24)} ${slow.gzip_bytes} of ${MOST.bytes} bytes`,
  ];
}

/** Throws a message that names the missed goals. */
export function checkFirstSeconds({ slow_4g: slow, local }) {
  const missed = [];
  if (slow.styled_ms > MOST.slowMs) missed.push("on slow 4G");
  if (local.styled_ms > MOST.localMs) missed.push("on this machine");
  if (slow.gzip_bytes > MOST.bytes) missed.push("in bytes");
  if (missed.length > 0) throw new Sentence(`The first styled frame misses its goals: ${missed.join(", ")}.`);
}
