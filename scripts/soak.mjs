// npm run soak -- [--minutes N] [--seed N]: a long time of one page in Chromium. Styles change, views come and go, files are
// dropped and saved, all by chance from a seed. Every round ends in the same state, in which the memory of the page and of its
// WebAssembly modules is measured. It must not grow by more than 5 %, nothing may be thrown, and the same state must show the
// same frame. Needs the built site; not part of the tests.
import { readFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { onBuiltSite } from "../bench/built_site.mjs";
import { main, Sentence } from "./steps.mjs";

const DEFAULT_MINUTES = 60;
const MAX_GROWTH = 0.05;
/** Acts of a round. */
const ACTS = 12;
/** Rounds after which everything has been loaded once and memory can be compared. */
const WARM_UP_ROUNDS = 3;
const WAIT_MS = 120_000;
/** A view out of sight is disposed of after a minute; here after a twentieth of that. */
const HURRY = { fromMs: 60_000, factor: 20 };

/** The state in which every round ends. */
const REST = "play=0&frame=60&styles=proud:0.6,old:0.1,childlike:0.3&input=neutral walk";
const VIEWS = ["learn", "compare", "walk", "key-style", "crowd", "data"];

/** Numbers from 0 to 1 by a seed: mulberry32. */
function randomOf(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** In workers: remembers the memory of every module, for {@link wasmBytes}. */
function rememberMemories() {
  const memories = [];
  globalThis.wasmBytes = () => memories.reduce((sum, memory) => sum + memory.buffer.byteLength, 0);
  const Made = WebAssembly.Instance;
  WebAssembly.Instance = class extends Made {
    constructor(...given) {
      super(...given);
      memories.push(this.exports.memory);
    }
  };
  const { instantiate } = WebAssembly;
  WebAssembly.instantiate = async (...given) => {
    const made = await instantiate(...given);
    memories.push((made.instance ?? made).exports.memory);
    return made;
  };
  const { instantiateStreaming } = WebAssembly;
  WebAssembly.instantiateStreaming = async (...given) => {
    const made = await instantiateStreaming(...given);
    memories.push(made.instance.exports.memory);
    return made;
  };
}

/** The page, and what goes wrong in it. */
async function openPage(browser, url) {
  const context = await browser.newContext({
    viewport: { width: 960, height: 640 },
    deviceScaleFactor: 0.5,
    acceptDownloads: true,
    serviceWorkers: "block",
  });
  context.setDefaultTimeout(WAIT_MS);
  const page = await context.newPage();
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") errors.push(message.text());
  });
  await page.addInitScript(rememberMemories);
  await page.addInitScript(({ fromMs, factor }) => {
    const later = globalThis.setTimeout;
    globalThis.setTimeout = (act, ms = 0) => later(act, ms >= fromMs ? ms / factor : ms);
  }, HURRY);
  await page.route(/\/\w*worker-[^/]*\.js$/, async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: `(${rememberMemories})();${await response.text()}` });
  });
  await page.goto(`${url}#${REST}`);
  await page.waitForFunction(() => window.strut?.analysed);
  return { page, errors };
}

let visits = 0;

/** Puts the page into a state. */
async function visit(page, hash) {
  visits += 1;
  await page.evaluate((link) => {
    location.hash = link;
  }, `${hash}&visit=${visits}`);
  await page.waitForFunction((n) => !location.hash.includes(`visit=${n}`), visits);
}

/** Waits until a view is shown. */
const shown = (page, view) =>
  page.waitForFunction((view) => document.getElementById("app").dataset.view === view, view);

/** Goes to the state of the end of a round and gives the pose that is then on screen. */
async function rest(page) {
  await visit(page, REST);
  await shown(page, "play");
  await page.waitForFunction(() => window.strut.state.input === "neutral walk" && window.strut.analysed);
  await page.waitForFunction(() => window.strut.upToDate && window.strut.frame.inputFrame === 60);
  return page.evaluate(() => [...window.strut.frame.pose]);
}

/** Bytes of the page's heap and of all WebAssembly memory, once views out of sight are gone. */
async function memoryOf(page, session) {
  await page.waitForTimeout((1.5 * HURRY.fromMs) / HURRY.factor);
  await session.send("HeapProfiler.collectGarbage");
  const { usedSize } = await session.send("Runtime.getHeapUsage");
  const inWorkers = page.workers().map((worker) => worker.evaluate(() => globalThis.wasmBytes?.() ?? 0).catch(() => 0));
  const wasm = await Promise.all([page.evaluate(() => globalThis.wasmBytes()), ...inWorkers]);
  return { heap: usedSize, wasm: wasm.reduce((a, b) => a + b, 0) };
}

/** Saves the motion by the menu; gives the file. */
async function saved(page, format) {
  await page.getByRole("button", { name: "Export" }).click();
  const item = page.locator(".export-menu").getByRole("button", { name: new RegExp(`^${format}`) });
  const [download] = await Promise.all([page.waitForEvent("download"), item.click()]);
  const bytes = readFileSync(await download.path());
  await download.delete();
  return bytes;
}

/** What is done by chance, each from whatever the one before left. */
const ACTS_BY_NAME = {
  async style(page, random) {
    await visit(page, "play=1");
    await shown(page, "play");
    const corners = page.locator(".panels .vertex .vertex-dot");
    await corners.nth(Math.floor(random() * (await corners.count()))).dblclick({ force: true });
    await page.waitForTimeout(500 * random());
  },
  async view(page, random) {
    const view = VIEWS[Math.floor(random() * VIEWS.length)];
    await visit(page, `view=${view}${view === "crowd" ? "&crowd=20_1" : ""}`);
    await shown(page, view);
    await page.waitForTimeout(2000 * random());
  },
  async drop(page, random, clip) {
    await visit(page, "play=0");
    await shown(page, "play");
    const name = `mine-${Math.floor(random() * 3)}`;
    await page.evaluate(
      ({ name, text }) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([text], `${name}.bvh`));
        for (const type of ["dragenter", "dragover", "drop"])
          document.body.dispatchEvent(
            new DragEvent(type, { dataTransfer: transfer, bubbles: true, cancelable: true, clientX: 5, clientY: 5 }),
          );
      },
      { name, text: clip },
    );
    await page.waitForFunction((name) => window.strut.state.input === name, name);
  },
  async export(page, random) {
    await visit(page, "play=0");
    await shown(page, "play");
    await page.waitForFunction(() => window.strut.analysed);
    await saved(page, random() < 0.7 ? "BVH" : "GLB");
  },
  async undo(page) {
    await visit(page, "play=0");
    await shown(page, "play");
    await page.keyboard.press("Control+z");
  },
};

const megabytes = (bytes) => (bytes / 2 ** 20).toFixed(1);

/** Rounds until the time is over; gives the number of acts and what was measured after each round but the first ones. */
async function soak(page, errors, seed, minutes) {
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.enable");
  const random = randomOf(seed);
  const acts = Object.values(ACTS_BY_NAME);
  const until = performance.now() + minutes * 60_000;
  const clip = (await saved(page, "BVH")).toString();
  const first = await rest(page);
  const measured = [];
  for (let round = 1; performance.now() < until || measured.length < 2; round++) {
    for (let i = 0; i < ACTS; i++) await acts[Math.floor(random() * acts.length)](page, random, clip);
    const pose = await rest(page);
    const apart = Math.max(...pose.map((value, i) => Math.abs(value - first[i])));
    if (apart > 0) throw new Sentence(`The frame of round ${round} differs from the first by ${apart}.`);
    if (errors.length > 0) throw new Sentence(`In round ${round} of seed ${seed}: ${errors.join("; ")}`);
    const memory = await memoryOf(page, session);
    console.log(`round ${round}: heap ${megabytes(memory.heap)} MB, WebAssembly ${megabytes(memory.wasm)} MB`);
    if (round > WARM_UP_ROUNDS) measured.push(memory);
  }
  return measured;
}

await main(async () => {
  const { values } = parseArgs({ options: { minutes: { type: "string" }, seed: { type: "string" } } });
  const minutes = Number(values.minutes ?? DEFAULT_MINUTES);
  const seed = Number(values.seed ?? 1);
  if (!(minutes > 0) || !Number.isInteger(seed))
    throw new Sentence("--minutes is a number above 0, --seed a whole one.");
  const measured = await onBuiltSite(async (browser, url) => {
    const { page, errors } = await openPage(browser, url);
    return soak(page, errors, seed, minutes);
  });
  const growth = (kind) => measured.at(-1)[kind] / measured[0][kind] - 1;
  const said = (kind) => `${kind} ${(100 * growth(kind)).toFixed(1)} %`;
  const acts = ACTS * (measured.length + WARM_UP_ROUNDS);
  console.log(`${acts} acts; growth: ${said("heap")}, ${said("wasm")}; no error; every frame the same.`);
  if (Math.max(growth("heap"), growth("wasm")) > MAX_GROWTH) throw new Sentence("Memory has grown.");
});
