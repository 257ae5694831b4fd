/**
 * A performer to try live streams with: sends a BVH file, over and over, to whoever connects.
 *
 *   node send.js walk.bvh [--port 39541] [--format json|bvh]
 */
import { readFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { jsonFrame, jsonSkeleton, readBvh } from "./bvh.js";
import { serveMessages } from "./web_socket.js";

const { values, positionals } = parseArgs({
  options: { port: { type: "string", default: "39541" }, format: { type: "string", default: "json" } },
  allowPositionals: true,
});
const [file] = positionals;
if (file === undefined || !["json", "bvh"].includes(values.format)) {
  console.error("node send.js FILE.bvh [--port 39541] [--format json|bvh]");
  process.exit(2);
}

const bvh = readBvh(readFileSync(file, "utf8"));
const isJson = values.format === "json";
// Who connects is told the skeleton first.
const server = await serveMessages(Number(values.port), () => [isJson ? jsonSkeleton(bvh) : bvh.header]);
console.log(`${file}: ${bvh.frames.length} frames at ${Math.round(1 / bvh.frameSecs)} Hz to ${server.url}`);

const begin = performance.now() / 1000;
let sent = 0;
setInterval(() => {
  const due = Math.floor((performance.now() / 1000 - begin) / bvh.frameSecs);
  for (; sent <= due; sent++) {
    const i = sent % bvh.frames.length;
    // The time is that of the clip: where it goes back, Strut goes on without a leap.
    server.send(isJson ? jsonFrame(bvh, bvh.frames[i], i * bvh.frameSecs) : bvh.frames[i].join(" "));
  }
}, 4);
