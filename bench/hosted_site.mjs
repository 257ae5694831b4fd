// dist/ served as a static host does: compressed once with Brotli, and files whose names hold their hash cached for good.
import { readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, relative, sep } from "node:path";
import { promisify } from "node:util";
import { brotliCompress } from "node:zlib";

/** Types of what is sent; other files are bytes. */
const TYPES = {
  ".css": "text/css; charset=utf-8",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".woff2": "font/woff2",
};
/** What is small already: fonts are compressed, and so are the packed motions. */
const COMPRESSED = new Set([".woff2", ".bin", ".strutwalk"]);

const compress = promisify(brotliCompress);

/** The answer to a request for a file. */
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

/** Parts in which a slow line carries an answer, bytes. */
const PART = 4096;

/**
 * A line that carries `bytesPerSec` in all, each answer `latencyMs` after it was asked for. The browser's own emulation does not
 * reach what workers load.
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
 * @param line `bytesPerSec` and `latencyMs` of a slow line; none where it is left out
 * @returns the address, what was sent (path, bytes and time of each answer), and a function that ends it
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
