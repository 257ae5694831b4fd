/**
 * A page that repeatedly inserts and removes players, like an application, must not use more memory at the end than at
 * the start: 100 mounts, or STRUT_MOUNTS (1,000 take minutes).
 */
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { CDPSession, Page } from "playwright-core";
import { expect, onTestFinished, test } from "vitest";
import type { Reply, Request } from "../../web/client/rpc";
import type { StrutPlayer } from "../../web/element";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { launchBrowser } from "./browser";
import { type Graphics, softwareGraphics } from "./graphics";

const MOUNTS = Number(process.env.STRUT_MOUNTS ?? 100);
/** Number of warm-up mounts, whose loaded and compiled code stays. */
const WARM = MOUNTS / 10;

/**
 * Machine code counts as heap, and V8 compiles more and more of it: 8 % of the heap from the 100th to the 1,000th
 * mount, while heap snapshots show no additional object. Without its compilers only objects are counted.
 */
function graphics(): Graphics {
  const { args, env } = softwareGraphics();
  return { args: [...args, "--js-flags=--no-opt --no-maglev --no-sparkplug"], env };
}

/** Resources of a page. */
interface Held {
  /** Bytes of the page's JavaScript heap after a garbage collection. */
  heap: number;
  /** Nodes of the page, and detached ones that scripts keep. */
  nodes: number;
  listeners: number;
  /** Bytes of the engine's WebAssembly memory. */
  wasm: number;
}

/** Values that the page records. */
declare const window: { workers: Worker[]; contexts: number };

/** Records the workers that a page starts, and counts its WebGL contexts. */
function notes(): void {
  Object.assign(window, { workers: [], contexts: 0 });
  const Original = Worker;
  globalThis.Worker = class extends Original {
    constructor(...given: ConstructorParameters<typeof Worker>) {
      super(...given);
      window.workers.push(this);
    }
  };
  const { getContext } = HTMLCanvasElement.prototype;
  const counted = new WeakSet<object>();
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...given: unknown[]) {
    const made = Reflect.apply(getContext, this, given);
    // The first context tests the renderer, and is released immediately.
    const isAsked = this.width === 1 && this.height === 1;
    if (made && given[0] === "webgl2" && !isAsked && !counted.has(made)) {
      counted.add(made);
      window.contexts += 1;
    }
    return made;
  } as typeof getContext;
}

/** Inserts players one at a time, waits until each is drawn, and removes it. */
function mount(page: Page, times: number): Promise<void> {
  return page.evaluate(async (count) => {
    for (let i = 0; i < count; i++) {
      const player = document.createElement("strut-player") as StrutPlayer;
      player.setAttribute("controls", "");
      document.body.append(player);
      await player.ready;
      player.remove();
    }
  }, times);
}

/** Returns the page's resources after garbage collection. */
async function held(page: Page, session: CDPSession): Promise<Held> {
  // Several rounds for resources that timers and other threads release.
  for (let i = 0; i < 3; i++) {
    await session.send("HeapProfiler.collectGarbage");
    await page.waitForTimeout(200);
  }
  const { usedSize } = await session.send("Runtime.getHeapUsage");
  const { nodes, jsEventListeners } = await session.send("Memory.getDOMCounters");
  const wasm = await page.evaluate(
    () =>
      new Promise<number>((resolve) => {
        const id = Number.MAX_SAFE_INTEGER;
        const [worker] = window.workers;
        const take = ({ data }: MessageEvent<Reply>) => {
          if (data.kind !== "result" || data.id !== id) return;
          worker!.removeEventListener("message", take);
          resolve((data.value as { wasmBytes: number }).wasmBytes);
        };
        worker!.addEventListener("message", take);
        const request: Request = { kind: "call", id, method: "memory", args: [] };
        worker!.postMessage(request);
      }),
  );
  return { heap: usedSize, nodes, listeners: jsEventListeners, wasm };
}

/** Returns whether a page uses no more than before. */
const isWithin = (after: Held, before: Held): boolean =>
  after.wasm === before.wasm &&
  after.nodes <= before.nodes &&
  after.listeners <= before.listeners &&
  after.heap <= 1.05 * before.heap;

test(`${MOUNTS} mounts leave a page as ${WARM} do`, { timeout: 3_600_000 }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "strut-mounts-"));
  for (const file of ["strut-player.js", "walk.bin"]) cpSync(join(root, "dist", "package", file), join(folder, file));
  writeFileSync(
    join(folder, "index.html"),
    '<!doctype html><title>A page</title><script src="strut-player.js"></script>',
  );
  const [browser, server] = await Promise.all([launchBrowser({ graphics: graphics() }), serveFolder(folder)]);
  onTestFinished(async () => {
    await browser.close();
    await server.close();
    rmSync(folder, { recursive: true });
  });
  const page = await browser.newPage({ viewport: { width: 480, height: 320 } });
  await page.addInitScript(notes);
  await page.goto(server.url);
  const session = await page.context().newCDPSession(page);

  await mount(page, WARM);
  const before = await held(page, session);
  const started = performance.now();
  await mount(page, MOUNTS - WARM);
  const mountMs = (performance.now() - started) / (MOUNTS - WARM);
  let after = await held(page, session);
  // A slow machine takes longer to release the resources of other threads.
  for (let i = 0; i < 20 && !isWithin(after, before); i++) after = await held(page, session);
  const counts = await page.evaluate(() => ({ workers: window.workers.length, contexts: window.contexts }));
  console.log(JSON.stringify({ mounts: MOUNTS, mountMs, before, after, ...counts }));

  expect(counts).toEqual({ workers: 1, contexts: 1 });
  expect(after.wasm).toBe(before.wasm);
  expect(after.nodes).toBeLessThanOrEqual(before.nodes);
  expect(after.listeners).toBeLessThanOrEqual(before.listeners);
  expect(after.heap).toBeLessThanOrEqual(1.05 * before.heap);
});
