// npm run soak [-- --minutes N] [--seed N] [--json FILE]: checks that the page is stable in long use. In Chromium,
// styles, views, drops and exports are chosen by a seeded generator. Between the end of the first quarter and the end,
// the reachable memory after garbage collection, without code, and apart from it the memory of WebAssembly may grow by at
// most 5 %.
// No error may be shown or thrown. The same link must show the bit-identical pose at the start, at intervals, and at
// the end. Needs the built site. Not part of the tests.
import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { setTimeout as wait } from "node:timers/promises";
import { parseArgs } from "node:util";
import puppeteer from "puppeteer-core";
import { FLAGS, serveBuiltSite } from "../bench/built_site.mjs";
import { reachable } from "../bench/reachable.mjs";
import { generator, shuffled } from "./random.mjs";
import { main, Sentence } from "./steps.mjs";

const VIEWS = ["play", "learn", "compare", "walk", "key-style", "crowd", "data"];
const STYLES = ["proud", "old", "childlike", "sexy", "angry", "depressed"];
/** The state in which pose and memory are measured. */
const FIXED = "play=0&frame=60&styles=proud:0.62,old:0.12,childlike:0.26";
/** Hidden views are disposed of after a minute: afterwards the measurement shows what the page keeps. */
const SETTLING_MS = 70_000;
/** Number of actions after which that state is shown. */
const ACTS_BETWEEN = 50;
/** Range of the pause after an action, milliseconds. */
const PAUSE_MS = [100, 2000];
const MOST_GROWTH_PERCENT = 5;
/** Timeout for a state on a busy machine, milliseconds. */
const PATIENCE_MS = 120_000;

/** Runs in the page before its scripts: counts downloads, keeps them off the disk, and holds the last one. */
function keepDownloads() {
  window.soak = { downloads: 0, last: undefined, faults: [] };
  const create = URL.createObjectURL.bind(URL);
  URL.createObjectURL = (object) => {
    if (object instanceof Blob) window.soak.last = object;
    return create(object);
  };
  const click = HTMLAnchorElement.prototype.click;
  HTMLAnchorElement.prototype.click = function () {
    if (this.download) window.soak.downloads += 1;
    else click.call(this);
  };
  document.addEventListener("securitypolicyviolation", ({ violatedDirective }) =>
    window.soak.faults.push(`against the policy: ${violatedDirective}`),
  );
}

/** User actions, each with a page and the generator. */
const ACTS = {
  /** Sets a mixture of three styles. */
  style: (page, random) => {
    const names = shuffled(STYLES, random).slice(0, 3);
    const shares = names.map(() => random());
    const sum = shares.reduce((a, b) => a + b);
    const styles = names.map((name, i) => `${name}:${(shares[i] / sum).toFixed(2)}`);
    return go(page, `styles=${styles}&intensity=${(0.5 + random()).toFixed(2)}`);
  },
  /** Shows another view. */
  view: (page, random) => go(page, `view=${VIEWS[Math.floor(random() * VIEWS.length)]}`),
  /** Drops the motion that was exported at the start. */
  drop: async (page) => {
    await go(page, "");
    await page.evaluate(() => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([window.soak.bvh], "soak.bvh"));
      for (const type of ["dragenter", "dragover", "drop"]) {
        const at = { clientX: 5, clientY: 5, bubbles: true, cancelable: true };
        document.body.dispatchEvent(new DragEvent(type, { ...at, dataTransfer: transfer }));
      }
    });
  },
  /** Exports what the view shows, if it can be exported. */
  export: (page, random) => press(page, random() < 0.5 ? "BVH" : "GLB"),
  /** Plays or pauses. */
  play: (page) => page.keyboard.press("Space"),
  undo: async (page) => {
    await page.keyboard.down("Control");
    await page.keyboard.press("z");
    await page.keyboard.up("Control");
  },
};

/** Opens the state of a link. */
async function go(page, hash) {
  await page.evaluate((hash) => {
    location.hash = `${hash}&soak=${performance.now()}`;
  }, hash);
  await page.waitForFunction(() => !location.hash.includes("soak="));
}

/** Presses the button of the view, or the item of the Export menu, that exports a format. */
function press(page, format) {
  return page.evaluate((format) => {
    const buttons = [...document.querySelectorAll(".editor-actions button, .crowd-foot button, .export-menu button")];
    const fitting = buttons.filter((one) => one.textContent.startsWith(format) && !one.disabled);
    const inView = fitting.find((one) => one.checkVisibility());
    (inView ?? fitting.at(-1))?.click();
  }, format);
}

/** Returns the pose of {@link FIXED}. */
async function fixedPose(page) {
  await go(page, FIXED);
  const isShown = () => window.strut.upToDate && window.strut.analysed && window.strut.frame?.inputFrame === 60;
  try {
    await page.waitForFunction(isShown, { timeout: PATIENCE_MS });
  } catch {
    const shown = await page.evaluate(() => {
      const { state, upToDate, analysed, frame } = window.strut;
      return JSON.stringify({ upToDate, analysed, inputFrame: frame?.inputFrame, state });
    });
    throw new Sentence(`The page did not reach the state to be measured; its state is ${shown}.`);
  }
  return page.evaluate(() => [...window.strut.frame.pose]);
}

/** Returns the bytes of page and workers in the state of {@link FIXED}, after hidden views were disposed of. */
async function measure(page) {
  await fixedPose(page);
  await wait(SETTLING_MS);
  const session = await page.createCDPSession();
  const clients = [session, ...page.workers().map(({ client }) => client)];
  const bytes = { heap: 0, code: 0, wasm: 0, workers: clients.length - 1 };
  for (const client of clients) {
    const wasm = await wasmBytes(client);
    const { data, code } = await reachable(client);
    bytes.wasm += wasm;
    // The snapshot includes the memory of WebAssembly.
    bytes.heap += data - wasm;
    bytes.code += code;
  }
  await session.detach();
  return bytes;
}

/** Returns the bytes of all WebAssembly memories of a page or worker. */
async function wasmBytes(client) {
  await client.send("HeapProfiler.collectGarbage");
  const prototype = await client.send("Runtime.evaluate", { expression: "WebAssembly.Memory.prototype" });
  const { objects } = await client.send("Runtime.queryObjects", { prototypeObjectId: prototype.result.objectId });
  const { result } = await client.send("Runtime.callFunctionOn", {
    objectId: objects.objectId,
    functionDeclaration: "function () { return this.reduce((sum, { buffer }) => sum + buffer.byteLength, 0); }",
    returnByValue: true,
  });
  for (const objectId of [objects.objectId, prototype.result.objectId])
    await client.send("Runtime.releaseObject", { objectId });
  return result.value;
}

/**
 * Does one action after another until a time. Counts each kind of action, and collects the poses of the fixed state.
 */
async function use(page, random, until, { counts, poses }) {
  const names = Object.keys(ACTS);
  for (let acts = 1; performance.now() < until; acts++) {
    const name = names[Math.floor(random() * names.length)];
    await ACTS[name](page, random);
    counts[name] = (counts[name] ?? 0) + 1;
    await wait(PAUSE_MS[0] + random() * (PAUSE_MS[1] - PAUSE_MS[0]));
    await collectErrors(page);
    if (acts % ACTS_BETWEEN === 0) poses.push(String(await fixedPose(page)));
  }
}

/** Collects the page's error messages, which disappear after a while. */
function collectErrors(page) {
  return page.evaluate(() => {
    for (const note of document.querySelectorAll(".toast.error")) {
      window.soak.faults.push(note.textContent);
      note.querySelector("button")?.click();
    }
  });
}

async function soak(page, url, minutes, seed) {
  const thrown = [];
  page.on("pageerror", ({ message }) => thrown.push(message));
  await page.evaluateOnNewDocument(keepDownloads);
  await page.goto(url);
  await page.waitForFunction(() => window.strut?.analysed, { timeout: PATIENCE_MS });
  const used = { counts: {}, poses: [String(await fixedPose(page))] };
  await press(page, "BVH");
  await page.waitForFunction(() => window.soak.last !== undefined, { timeout: PATIENCE_MS });
  await page.evaluate(async () => {
    window.soak.bvh = await window.soak.last.text();
  });
  const random = generator(seed);
  const started = performance.now();
  await use(page, random, started + (minutes * 60_000) / 4, used);
  const quarter = await measure(page);
  console.log(`after a quarter  ${lineOf(quarter)}`);
  await use(page, random, performance.now() + (minutes * 60_000 * 3) / 4, used);
  const end = await measure(page);
  console.log(`at the end       ${lineOf(end)}`);
  used.poses.push(String(await fixedPose(page)));
  const { faults, downloads } = await page.evaluate(() => window.soak);
  const same = new Set(used.poses).size === 1;
  return {
    quarter,
    end,
    counts: used.counts,
    shown: used.poses.length,
    downloads,
    errors: [...thrown, ...faults],
    same,
  };
}

const megabytes = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
const lineOf = ({ heap, code, wasm, workers }) =>
  `heap ${megabytes(heap)}, code ${megabytes(code)}, WebAssembly ${megabytes(wasm)}, ${workers} workers`;

/** Returns a message for each violated requirement. */
function faultsOf({ quarter, end, errors, same }) {
  const growth = (kind) => (100 * (end[kind] - quarter[kind])) / quarter[kind];
  const grown = ["heap", "wasm"].filter((kind) => growth(kind) > MOST_GROWTH_PERCENT);
  return [
    ...grown.map((kind) => `${kind} grew by ${growth(kind).toFixed(1)} %.`),
    ...errors.map((error) => `The page failed: ${error}`),
    ...(same ? [] : ["The same link did not always show the same pose."]),
  ];
}

await main(async () => {
  const { values } = parseArgs({
    options: {
      minutes: { type: "string", default: "60" },
      seed: { type: "string", default: "1" },
      json: { type: "string" },
    },
  });
  const [minutes, seed] = [Number(values.minutes), Number(values.seed)];
  if (!(minutes > 0)) throw new Sentence(`Invalid minutes '${values.minutes}'. Expected a number above 0.`);
  console.log(`machine          ${cpus().length} × ${cpus()[0].model}, seed ${seed}`);
  const site = await serveBuiltSite();
  const browser = await puppeteer.launch({
    executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
    args: FLAGS,
    defaultViewport: { width: 960, height: 640, deviceScaleFactor: 0.5 },
    protocolTimeout: 300_000,
  });
  try {
    const result = await soak(await browser.newPage(), site.resolvedUrls.local[0], minutes, seed);
    const done = Object.entries(result.counts).map(([name, count]) => `${count} × ${name}`);
    console.log(`done             ${done.join(", ")}; ${result.downloads} files saved, ${result.shown} poses compared`);
    if (values.json) writeFileSync(values.json, `${JSON.stringify({ minutes, seed, ...result }, undefined, 2)}\n`);
    const faults = faultsOf(result);
    if (faults.length > 0) throw new Sentence(faults.join("\n"));
  } finally {
    await browser.close();
    await site.close();
  }
});
