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

/** Serves the files of a folder that `serves` accepts, on a free port. Returns the address and a function that ends it. */
export async function serveCompressed(folder, serves = () => true) {
  const paths = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(folder, join(entry.parentPath ?? entry.path, entry.name)).replaceAll(sep, "/"))
    .filter(serves);
  const answers = new Map(await Promise.all(paths.map(async (path) => [path, await answerOf(folder, path)])));
  const server = createServer(({ url }, response) => {
    const { pathname } = new URL(url, "http://localhost");
    const answer = answers.get(pathname === "/" ? "index.html" : pathname.slice(1));
    if (!answer) response.writeHead(404).end();
    else response.writeHead(200, answer.headers).end(answer.body);
  });
  await new Promise((resolve) => server.listen(0, "localhost", resolve));
  const close = () =>
    new Promise((resolve) => {
      server.close(resolve);
      server.closeAllConnections();
    });
  return { url: `http://localhost:${server.address().port}/`, close };
}
