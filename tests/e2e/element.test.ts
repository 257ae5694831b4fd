/** `<strut-player>` on other pages: loaded by a script tag, many at once, with the keyboard, with missing features. */
import { cpSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { chunksOf } from "../../web/character/glb_patch";
import type { StrutPlayer } from "../../web/element";
import type { StrutError } from "../../web/engine/errors";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { axeFaults } from "./axe";
import { drag, eventually, launchBrowser, middleOf, screenshot } from "./browser";

/** Values that the pages of these tests record. */
declare const window: {
  workers: number;
  contexts: number;
  chosen: Record<string, number>[];
  /** Whether the player handled each turn of the wheel. */
  taken: boolean[];
  player: StrutPlayer;
};

let browser: Browser;
let folder: string;
let server: Awaited<ReturnType<typeof serveFolder>>;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-element-"));
  for (const file of ["strut-player.js", "walk.bin", "walk.bin.js"])
    cpSync(join(root, "dist", "package", file), join(folder, file));
  [browser, server] = await Promise.all([launchBrowser(), serveFolder(folder)]);
});
afterAll(async () => {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
});

const SCRIPT = '<script src="strut-player.js"></script>';

/** Opens a page with a body, and counts its workers and WebGL contexts. */
async function open(body: string, options: BrowserContextOptions = {}): Promise<Page> {
  const html = `<!doctype html><html lang="en"><title>A page</title><meta charset="utf-8"><main><h1>A page</h1>${body}</main></html>`;
  writeFileSync(join(folder, "index.html"), html);
  const context = await browser.newContext({ viewport: { width: 800, height: 600 }, ...options });
  await context.addInitScript(() => {
    Object.assign(window, { workers: 0, contexts: 0, chosen: [] });
    const Original = Worker;
    globalThis.Worker = class extends Original {
      constructor(...given: ConstructorParameters<typeof Worker>) {
        super(...given);
        window.workers += 1;
      }
    };
    const counted = new WeakSet<object>();
    const { getContext } = HTMLCanvasElement.prototype;
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
    document.addEventListener("stylechange", (event) => {
      window.chosen.push((event as CustomEvent<{ styles: Record<string, number> }>).detail.styles);
    });
  });
  const page = await context.newPage();
  page.on("pageerror", (error) => {
    throw error;
  });
  await page.goto(server.url);
  return page;
}

/** Opens a page with one player, and waits until it is ready. */
async function openPlayer(attributes: string, options?: BrowserContextOptions): Promise<Page> {
  const page = await open(`${SCRIPT}<strut-player ${attributes}></strut-player>`, options);
  await page.evaluate(async () => {
    window.player = document.querySelector("strut-player") as StrutPlayer;
    await window.player.ready;
  });
  return page;
}

const stylesOf = (page: Page) => page.evaluate(() => window.player.styles);
const timeOf = (page: Page) => page.evaluate(() => window.player.currentTime);

describe("a player", () => {
  test("walks where it is seen, after the three lines of the README", async () => {
    const readme = readFileSync(join(root, "README.md"), "utf8");
    const lines = /```html\n(<!doctype html>[\s\S]*?)```/.exec(readme)![1]!;
    expect(lines.trim().split("\n")).toHaveLength(3);
    const page = await open(lines.replace("<!doctype html>", ""));
    await page.evaluate(() => {
      window.player = document.querySelector("strut-player") as StrutPlayer;
      return window.player.ready;
    });
    await eventually(() => timeOf(page)).toBeGreaterThan(0.3);
    expect(await page.evaluate(() => [window.workers, window.contexts])).toEqual([1, 1]);
    await page.context().close();
  });

  test("waits for a visitor who asked for less motion", async () => {
    const page = await openPlayer("autoplay controls", { reducedMotion: "reduce" });
    expect(await page.evaluate(() => window.player.paused)).toBe(true);
    await page.getByRole("button", { name: "Play" }).click();
    await eventually(() => timeOf(page)).toBeGreaterThan(0.1);
    await page.context().close();
  });

  test("reflects its properties, and takes those of frameworks", async () => {
    const page = await openPlayer('styles="old"');
    expect(await stylesOf(page)).toEqual({ old: 1 });
    const reflected = await page.evaluate(() => {
      const { player } = window;
      player.styles = { proud: 0.75, old: 0.25 };
      player.speed = 2;
      player.ghost = "off";
      player.autoplay = true;
      return player.outerHTML;
    });
    expect(reflected).toBe(
      '<strut-player styles="proud:0.75,old:0.25" speed="2" ghost="off" autoplay=""></strut-player>',
    );
    expect(await stylesOf(page)).toEqual({ proud: 0.75, old: 0.25 });
    await page.context().close();
  });

  test("lets the page scroll under the wheel, unless it has the focus or Ctrl is held; nothing zooms where that is switched off", async () => {
    const page = await openPlayer('style="margin-bottom: 2000px"');
    await page.evaluate(() => {
      Object.assign(window, { taken: [] });
      document.addEventListener("wheel", (event) => window.taken.push(event.defaultPrevented));
    });
    const { x, y } = await middleOf(page.locator("strut-player"));
    /** Returns whether the picture handles a turn of the wheel. */
    const takes = async () => {
      await page.evaluate(() => scrollTo(0, 0));
      await page.mouse.move(x, y);
      await page.mouse.wheel(0, 100);
      await eventually(() => page.evaluate(() => window.taken.length)).toBe(1);
      return page.evaluate(() => window.taken.pop());
    };
    const scrolled = () => page.evaluate(() => scrollY);
    expect(await takes()).toBe(false);
    await eventually(scrolled).toBeGreaterThan(50);
    await page.keyboard.down("Control");
    expect(await takes(), "with Ctrl").toBe(true);
    await page.keyboard.up("Control");
    await page.evaluate(() => scrollTo(0, 0));
    await page.mouse.click(x, y);
    expect(await takes(), "with the focus").toBe(true);
    await page.evaluate(() => {
      window.player.disableZoom = true;
    });
    expect(await takes(), "where it is switched off").toBe(false);
    expect(await page.evaluate(() => window.player.getAttribute("disable-zoom"))).toBe("");
    await page.context().close();
  });

  test("changes its style by the handle, and tells the page", async () => {
    const page = await openPlayer('controls styles="proud:0.5,old:0.5"');
    const handle = page.getByRole("slider", { name: "Style" });
    const from = await middleOf(handle);
    await drag(page, from, { x: from.x - 12, y: from.y + 18 });
    await eventually(async () => (await stylesOf(page)).old).toBeGreaterThan(0.6);
    expect(await page.evaluate(() => window.chosen.at(-1))).toEqual(await stylesOf(page));
    expect(await page.evaluate(() => window.player.getAttribute("styles"))).toContain("old:");
    await page.context().close();
  });

  test("is used by the keyboard alone", async () => {
    const page = await openPlayer('controls styles="proud:0.5,old:0.5"');
    await page.keyboard.press("Tab");
    await page.keyboard.press("Space");
    await eventually(() => timeOf(page)).toBeGreaterThan(0);
    await page.keyboard.press("Space");
    await page.keyboard.press("End");
    const duration = await page.evaluate(() => window.player.duration);
    await eventually(() => timeOf(page)).toBeCloseTo(duration, 1);
    await page.keyboard.press("Home");
    await eventually(() => timeOf(page)).toBe(0);
    await page.keyboard.press("1");
    await eventually(() => stylesOf(page)).toMatchObject({ proud: 1 });
    await page.keyboard.press("g");
    await eventually(() => page.evaluate(() => window.player.ghost)).toBe("overlay");
    await page.keyboard.press("l");
    await eventually(() => page.evaluate(() => window.player.once)).toBe(true);
    await page.getByRole("slider", { name: "Style" }).focus();
    await page.keyboard.press("ArrowDown");
    await eventually(async () => (await stylesOf(page)).proud).toBeLessThan(1);
    await page.context().close();
  });

  test("has no fault that axe finds, with all of its controls, light and dark", async () => {
    for (const theme of ["light", "dark"]) {
      const page = await openPlayer(`controls theme="${theme}"`);
      await eventually(() => axeFaults(page)).toEqual([]);
      await page.context().close();
    }
  });

  test("takes the state of a link, below its own attributes", async () => {
    const page = await openPlayer('state="styles=old:1&ghost=off&speed=2" ghost="overlay" controls');
    expect(await stylesOf(page)).toEqual({ old: 1 });
    const pressed = page.getByRole("button", { name: "Input" });
    await eventually(() => pressed.getAttribute("title")).toContain("overlaid");
    await page.context().close();
  });

  test("gives its picture and its motion", async () => {
    const page = await openPlayer("");
    const said = await page.evaluate(async () => {
      const { player } = window;
      const [picture, bvh, glb] = [
        await player.toBlob(),
        await player.exportFile("bvh"),
        await player.exportFile("glb"),
      ];
      return { picture: picture.type, bvh: (await bvh.text()).slice(0, 9), glb: await glb.slice(0, 4).text() };
    });
    expect(said).toEqual({ picture: "image/png", bvh: "HIERARCHY", glb: "glTF" });
    await page.context().close();
  });
});

describe("a character", () => {
  const rig = makeRig(FAMILIES.find(({ name }) => name === "VRM 1")!);
  const restricted = makeRig(rig.family, {
    document: ({ extensions }) => {
      Object.assign(extensions!.VRMC_vrm!.meta as object, { avatarPermission: "onlyAuthor" });
    },
  });
  beforeAll(() => {
    // The only file that characters need in addition to the player's script.
    cpSync(join(root, "dist", "package", "strut-character.js"), join(folder, "strut-character.js"));
    writeFileSync(join(folder, "character.glb"), rig.glb);
    writeFileSync(join(folder, "restricted.glb"), restricted.glb);
  });
  const credit = (page: Page) => page.locator("strut-player p.credit");
  const alert = (page: Page) => page.locator("strut-player").getByRole("alert");

  test("that is compressed with Draco performs where the decoder lies beside the script", async () => {
    const packed = new Uint8Array(readFileSync(join(root, "tests", "rigs", "mixamo_draco.glb")));
    writeFileSync(join(folder, "packed.glb"), packed);
    const page = await openPlayer('character="packed.glb"');
    await eventually(() => alert(page).innerText()).toContain("/assets/draco_decoder.wasm");
    const decoder = join("assets", "draco_decoder.wasm");
    cpSync(join(root, "dist", "package", decoder), join(folder, decoder));
    await page.evaluate(() => window.player.setAttribute("character", "./packed.glb"));
    await eventually(() => alert(page).isVisible()).toBe(false);
    // It exports the character's own file.
    const exported = () =>
      page.evaluate(async () =>
        Array.from(new Uint8Array(await (await window.player.exportFile("glb")).arrayBuffer())),
      );
    const own = chunksOf(packed).binary;
    await eventually(async () => {
      const { binary } = chunksOf(Uint8Array.from(await exported()));
      return Buffer.compare(binary.subarray(0, own.length), own);
    }).toBe(0);
    await page.context().close();
  });

  test("performs in the mannequin's place, is credited, and is exported", async () => {
    const page = await openPlayer('character="character.glb" styles="old" controls');
    await eventually(() => credit(page).innerText()).toBe("Mannequin by Strut");
    const glb = await page.evaluate(async () =>
      Array.from(new Uint8Array(await (await window.player.exportFile("glb")).arrayBuffer())),
    );
    const [own, out] = [chunksOf(rig.glb), chunksOf(Uint8Array.from(glb))];
    expect(Buffer.compare(out.binary.subarray(0, own.binary.length), own.binary)).toBe(0);
    await eventually(() => axeFaults(page)).toEqual([]);
    await screenshot(page, "element-character");
    await page.evaluate(() => window.player.removeAttribute("character"));
    await eventually(() => credit(page).isVisible()).toBe(false);
    await page.context().close();
  });

  test("that is missing leaves the mannequin performing, and a sentence", async () => {
    const page = await openPlayer('character="nobody.glb"');
    await eventually(() => alert(page).innerText()).toContain("The file could not be loaded");
    await page.evaluate(() => window.player.setAttribute("character", "character.glb"));
    await eventually(() => credit(page).isVisible()).toBe(true);
    await eventually(() => alert(page).isVisible()).toBe(false);
    await page.context().close();
  });

  test("needs a file beside the script, which is named where it is missing", async () => {
    const page = await openPlayer('styles="old"');
    await page.route("**/strut-character.js", (route) => route.abort());
    await page.evaluate(() => window.player.setAttribute("character", "character.glb"));
    await eventually(() => alert(page).innerText()).toContain("strut-character.js could not be loaded");
    await page.context().close();
  });

  test("is freed while nobody has seen it for half a minute, and comes back", async () => {
    const page = await openPlayer('character="character.glb"');
    await eventually(() => credit(page).isVisible()).toBe(true);
    await page.evaluate(() => {
      // Waits of half a minute take a tenth of a second.
      const later = globalThis.setTimeout;
      Object.assign(globalThis, { setTimeout: (act: () => void, ms = 0) => later(act, ms === 30_000 ? 100 : ms) });
      document.querySelector("main")!.prepend(Object.assign(document.createElement("div"), { id: "screens" }));
      document.getElementById("screens")!.style.height = "300vh";
    });
    await eventually(() => credit(page).isHidden()).toBe(true);
    await page.evaluate(() => document.getElementById("screens")!.remove());
    await eventually(() => credit(page).isVisible()).toBe(true);
    await page.context().close();
  });

  test("that not everybody may perform is refused, unless the page accepts its terms", async () => {
    const page = await openPlayer('character="restricted.glb"');
    await eventually(() => alert(page).innerText()).toContain("does not allow everyone to perform with it");
    await page.evaluate(() => {
      window.player.accept = ({ authors }) => authors.includes("Strut");
      window.player.character = new URL("restricted.glb", location.href);
    });
    await eventually(() => credit(page).isVisible()).toBe(true);
    await page.context().close();
  });
});

describe("many players", () => {
  const twelve = Array.from({ length: 12 }, () => '<strut-player autoplay loading="eager"></strut-player>').join("<p>");

  test("share one engine and one context", async () => {
    const page = await open(SCRIPT + twelve);
    await page.evaluate(() =>
      Promise.all([...document.querySelectorAll<StrutPlayer>("strut-player")].map((player) => player.ready)),
    );
    expect(await page.evaluate(() => [window.workers, window.contexts])).toEqual([1, 1]);
    await page.context().close();
  });

  test("go on where others are taken away, and one that is moved goes on too", async () => {
    const page = await open(SCRIPT + twelve);
    const moved = await page.evaluate(async () => {
      const [first, second, ...others] = [...document.querySelectorAll<StrutPlayer>("strut-player")];
      await Promise.all([first!.ready, second!.ready]);
      for (const player of others) player.remove();
      second!.remove();
      document.querySelector("main")!.prepend(first!);
      const before = first!.currentTime;
      while (first!.currentTime === before) await new Promise(requestAnimationFrame);
      return { contexts: window.contexts };
    });
    expect(moved).toEqual({ contexts: 1 });
    await page.context().close();
  });
});

describe("a player that is moved or taken away", () => {
  test("goes on where it was, even if it is out of the page for a while", async () => {
    const page = await openPlayer("");
    const [before, after] = await page.evaluate(async () => {
      const { player } = window;
      player.currentTime = 2;
      while (Math.abs(player.currentTime - 2) > 0.05) await new Promise(requestAnimationFrame);
      const before = player.currentTime;
      player.remove();
      await new Promise((resolve) => setTimeout(resolve, 100));
      document.querySelector("h1")!.after(player);
      await new Promise((resolve) => setTimeout(resolve, 50));
      await player.ready;
      while (player.currentTime === 0) await new Promise(requestAnimationFrame);
      return [before, player.currentTime];
    });
    expect(after).toBeCloseTo(before!, 1);
    await page.context().close();
  });

  test("rejects what waits for it where it is taken away while it loads", async () => {
    const page = await open(`${SCRIPT}<strut-player loading="eager"></strut-player>`);
    const code = await page.evaluate(async () => {
      const player = document.querySelector("strut-player") as StrutPlayer;
      const waiting = player.ready.catch((error: { code: string }) => error.code);
      player.remove();
      return waiting;
    });
    expect(code).toBe("cancelled");
    await page.context().close();
  });

  test("rejects what waits for its first picture where it is taken away, and waits anew where it is put back", async () => {
    const page = await open(`${SCRIPT}<strut-player></strut-player>`);
    const codes = await page.evaluate(async () => {
      const player = document.querySelector("strut-player") as StrutPlayer;
      const codeOf = (ready: Promise<void>) =>
        ready.then(
          () => "ready",
          (error: { code: string }) => error.code,
        );
      const place = player.parentElement!;
      const codes: string[] = [];
      // It is loaded, but draws no frame.
      const draw = globalThis.requestAnimationFrame;
      globalThis.requestAnimationFrame = () => 1;
      const waiting = codeOf(player.load());
      while (player.duration === 0) await new Promise((resolve) => setTimeout(resolve, 20));
      player.remove();
      codes.push(await waiting);
      globalThis.requestAnimationFrame = draw;
      place.append(player);
      codes.push(await codeOf(player.ready));
      // It is reinserted while it is loading for its former place.
      player.src = "strut:neutral-walk";
      player.remove();
      await new Promise((resolve) => setTimeout(resolve, 0));
      place.append(player);
      codes.push(await codeOf(player.ready));
      return codes;
    });
    expect(codes).toEqual(["cancelled", "ready", "ready"]);
    await page.context().close();
  });

  test("is loaded and exported on a page that is hidden", async () => {
    const page = await open(`${SCRIPT}<strut-player></strut-player>`);
    const motion = await page.evaluate(async () => {
      // Simulates a background tab.
      Object.defineProperty(document, "hidden", { value: true });
      globalThis.requestAnimationFrame = () => 1;
      const player = document.querySelector("strut-player") as StrutPlayer;
      const late = new Promise<string>((resolve) => setTimeout(() => resolve("late"), 10_000));
      return Promise.race([late, player.exportFile("bvh").then((file) => file.slice(0, 9).text())]);
    });
    expect(motion).toBe("HIERARCHY");
    await page.context().close();
  });

  test("takes what a framework set before the element was defined", async () => {
    const page = await open('<strut-player loading="eager"></strut-player>');
    const said = await page.evaluate(async () => {
      const player = document.querySelector("strut-player") as StrutPlayer;
      const accept = () => true;
      Object.assign(player, { accept, currentTime: 1.5, speed: 2 });
      const script = Object.assign(document.createElement("script"), { src: "strut-player.js" });
      document.head.append(script);
      await customElements.whenDefined("strut-player");
      await player.ready;
      while (player.currentTime === 0) await new Promise(requestAnimationFrame);
      // A property of the object itself would hide the one of the element.
      const hiding = Object.keys(player);
      return { hiding, accepts: player.accept === accept, time: player.currentTime, speed: player.speed };
    });
    expect(said).toMatchObject({ hiding: [], accepts: true, speed: 2 });
    expect(said.time).toBeCloseTo(1.5, 1);
    await page.context().close();
  });
});

describe("where something is missing", () => {
  /** Returns why a page's player fails to load, once the page's fallback text is shown. */
  async function refusalOf(page: Page): Promise<string> {
    await page.getByText("A film instead").waitFor({ state: "visible" });
    const refusal = await page
      .locator("strut-player")
      .evaluate((player) =>
        (player as StrutPlayer).ready.catch(({ code, message }: StrutError) => `${code}: ${message}`),
      );
    await page.context().close();
    return refusal ?? "none";
  }

  test("a motion of another origin that does not allow it is a sentence", async () => {
    const other = await serveFolder(folder);
    const page = await open(`${SCRIPT}<strut-player src="${other.url}/walk.bvh"></strut-player>`);
    const alert = page.locator("strut-player").getByRole("alert");
    await eventually(() => alert.innerText()).toMatch(/walk\.bvh could not be loaded: .*\(CORS\)/);
    await page.context().close();
    await other.close();
  });

  test("a sentence says so, and trying again helps once it is there", async () => {
    const page = await open(`${SCRIPT}<strut-player src="walk.bvh" controls></strut-player>`);
    const alert = page.locator("strut-player").getByRole("alert");
    await eventually(() => alert.innerText()).toContain("walk.bvh");
    const reason = await page.evaluate(async () => {
      window.player = document.querySelector("strut-player") as StrutPlayer;
      return window.player.ready.catch((error: { code: string }) => error.code);
    });
    expect(reason).toBe("load");
    await page.evaluate(() => window.player.setAttribute("src", "strut:neutral-walk"));
    await page.evaluate(() => window.player.ready);
    await eventually(() => alert.isHidden()).toBe(true);
    await page.context().close();
  });

  test("a style that the database lacks is named, and what is on the stage stays", async () => {
    const page = await openPlayer('styles="old"');
    await page.evaluate(() => window.player.setAttribute("styles", "sleepy"));
    await eventually(() => page.locator("strut-player").getByRole("alert").innerText()).toContain("sleepy");
    expect(await stylesOf(page)).toEqual({ old: 1 });
    await page.context().close();
  });

  test("without WebGL 2 the page's own words are shown", async () => {
    const body = `<script>
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
      };
    </script>${SCRIPT}<strut-player><p slot="fallback">A film instead</p></strut-player>`;
    expect(await refusalOf(await open(body))).toMatch(/^unsupported: .*WebGL/);
  });

  test("without SIMD in WebAssembly too", async () => {
    // The worker is started from a blob; the browser must report no SIMD there, too.
    const body = `<script>
      const Original = Blob;
      const NO_SIMD = "WebAssembly.validate = () => false;";
      globalThis.Blob = function (parts, options) {
        return new Original(options?.type === "text/javascript" ? [NO_SIMD, ...parts] : parts, options);
      };
    </script>${SCRIPT}<strut-player><p slot="fallback">A film instead</p></strut-player>`;
    expect(await refusalOf(await open(body))).toMatch(/^unsupported: .*SIMD/);
  });

  /** Returns the message of a player in an iframe that may not fetch. */
  async function saidInFrame(): Promise<unknown> {
    const inner = `<script src="${server.url}/strut-player.js"></script><strut-player autoplay></strut-player>
      <script>document.querySelector("strut-player").ready.then(
        () => parent.postMessage("ready", "*"),
        ({ code, message }) => parent.postMessage(code + ": " + message, "*"));</script>`;
    const page = await open(`<iframe title="A figure" sandbox="allow-scripts" width="700" height="320"></iframe>`);
    const said = await page.evaluate(async (text) => {
      const ready = new Promise((resolve) =>
        addEventListener("message", ({ data, origin }) => resolve({ data, origin })),
      );
      document.querySelector("iframe")!.srcdoc = text;
      return ready;
    }, inner);
    await page.context().close();
    return said;
  }

  test("in a frame that may not fetch, it has its data by a script, or names the one that is missing", async () => {
    expect(await saidInFrame()).toEqual({ data: "ready", origin: "null" });
    const [script, away] = [join(folder, "walk.bin.js"), join(folder, "away.js")];
    renameSync(script, away);
    const data = "load: The built-in motions could not be loaded: walk.bin.js is missing next to strut-player.js.";
    expect(await saidInFrame()).toEqual({ data, origin: "null" });
    renameSync(away, script);
  });
});
