// Serves dist/ like a static host: compressed with Brotli once, and files with a hash in their names cached
// permanently.
import { readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, relative, sep } from "node:path";
import { promisify } from "node:util";
import { brotliCompress } from "node:zlib";

/** Content types; other files are sent as bytes. */
const TYPES = {
  ".css": "text/css; charset=utf-8",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".woff2": "font/woff2",
};
/** Types of files that are already compressed: fonts and packed motions. */
const COMPRESSED = new Set([".woff2", ".bin", ".strutwalk"]);

const compress = promisify(brotliCompress);

/** Returns the answer to a request for a file. */
async function answerOf(folder, path) {
  const bytes = readFileSync(join(folder, path));
  const ending = extname(path);
  const plain = COMPRESSED.has(ending);
  const body = plain ? bytes : await compress(bytes);
  const headers = {
    "Content-Type": TYPES[ending] ?? "application/octet-stream",
    "Content-Length": body.length,
    "Cache-Control": path.startsWith("assets/") ? "public, max-age=31536000, immutable" : "no-cache",
    ...(plain ? {} : { "Content-Encoding": "br", Vary: "Accept-Encoding" }),
  };
  return { headers, body };
}

/** Size of the parts in which a slow line carries an answer, bytes. */
const PART = 4096;

/**
 * Simulates a line that carries `bytesPerSec` in total, each answer `latencyMs` after its request. The browser's own
 * emulation does not affect the requests of workers.
 */
function slowLine({ bytesPerSec, latencyMs }) {
  let free = 0;
  const sleepUntil = (time) => new Promise((resolve) => setTimeout(resolve, time - performance.now()));
  return async (response, body) => {
    await sleepUntil(performance.now() + latencyMs);
    for (let at = 0; at < body.length && !response.destroyed; at += PART) {
      const part = body.subarray(at, at + PART);
      free = Math.max(free, performance.now()) + (1000 * part.length) / bytesPerSec;
      await sleepUntil(free);
      response.write(part);
    }
    response.end();
  };
}

const atOnce = (response, body) => response.end(body);

/**
 * Serves the files of a folder that `serves` accepts, on a free port.
 * @param line `bytesPerSec` and `latencyMs` of a slow line; unlimited without it
 * @returns the address, the sent answers (path, bytes and time of each), and a function that stops it
 */
export async function serveCompressed(folder, serves = () => true, line = null) {
  const carry = line ? slowLine(line) : atOnce;
  const sent = [];
  const paths = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(folder, join(entry.parentPath ?? entry.path, entry.name)).replaceAll(sep, "/"))
    .filter(serves);
  const answers = new Map(await Promise.all(paths.map(async (path) => [path, await answerOf(folder, path)])));
  const server = createServer(({ url }, response) => {
    const { pathname } = new URL(url, "http://localhost");
    const answer = answers.get(pathname === "/" ? "index.html" : pathname.slice(1));
    if (!answer) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, answer.headers);
    response.on("finish", () => sent.push({ path: pathname, bytes: answer.body.length, time: Date.now() }));
    void carry(response, answer.body);
  });
  await new Promise((resolve) => server.listen(0, "localhost", resolve));
  const close = () =>
    new Promise((resolve) => {
      server.close(resolve);
      server.closeAllConnections();
    });
  return { url: `http://localhost:${server.address().port}/`, sent, close };
}
