/**
 * The package on other pages, installed from its tarball: bundled, by import map, from another origin, under policies.
 */
import { cpSync, readdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build as esbuild } from "esbuild";
import type { Browser } from "playwright-core";
import { createServer, build as vite } from "vite";
import { afterAll, beforeAll, expect, test } from "vitest";
import { PARENTS, ROLES } from "../../web/humanoid";
import { type Consumer, FRAMES, installPackage, styledByNode } from "../package/consumer";
import {
  copyData,
  copyPackage,
  expected,
  html,
  program,
  type Said,
  summary,
  visitPage,
  writeSite,
} from "../package/page";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { launchBrowser } from "./browser";

const CORS = { "Access-Control-Allow-Origin": "*" };

/** The interface of a page of these tests. */
declare const window: { use: (file: string) => Promise<string> };

let browser: Browser;
let consumer: Consumer;
let elsewhere: Awaited<ReturnType<typeof serveFolder>>;
beforeAll(async () => {
  consumer = installPackage();
  [browser, elsewhere] = await Promise.all([launchBrowser(), serveFolder(consumer.installed, CORS)]);
}, 900_000);
afterAll(async () => {
  await browser.close();
  await elsewhere.close();
  consumer.remove();
});

const site = (name: string, files: Readonly<Record<string, string>>) => writeSite(consumer, name, files);

/** Makes a page with a copy of the package, imported by import map. */
function siteWithPackage(name: string, options = "", without?: string): string {
  const folder = site(name, {
    "index.html": html("main.js", "./strut-motion/index.js"),
    "main.js": program("strut-motion", options),
  });
  copyPackage(consumer, folder, without);
  return folder;
}

/** Serves a folder and opens its page; hosts other than its own and `elsewhere` are blocked. */
async function open(folder: string, headers?: Parameters<typeof serveFolder>[1], inFrame = false): Promise<Said> {
  const server = await serveFolder(folder, headers);
  try {
    return (await visitPage(browser, server.url, { allowed: [elsewhere.url], inFrame })).said;
  } finally {
    await server.close();
  }
}

/** Expects the command's output. */
function expectSame(said: Said, thread: string): void {
  expect(summary(said, consumer)).toEqual(expected(thread));
}

/** Makes a page whose module esbuild bundles. */
async function siteByEsbuild(name: string, options = ""): Promise<string> {
  const folder = site(name, { "index.html": html("bundle.js"), "main.js": program("strut-motion", options) });
  await esbuild({
    entryPoints: [join(folder, "main.js")],
    outfile: join(folder, "bundle.js"),
    bundle: true,
    format: "esm",
    logLevel: "error",
  });
  return folder;
}

/** The package's contract, as `tests/package/contract.mjs` tests it in Node. */
const CONTRACT = `import { loadStrut } from "strut-motion";
import * as THREE from "three";
window.said = (async () => {
  const source = new URL("/demo.strutdb", location.href);
  const fileOrText = await (await fetch("/walk.bvh")).text();
  const options = { styles: { old: 1 } };
  let progress = 0;
  const onProgress = ({ fraction }) => { progress = fraction; };
  const { signal } = new AbortController();

  const strut = await loadStrut();
  const db = await strut.openDatabase(source, { onProgress, signal });
  const motion = await strut.openMotion(fileOrText);
  const result = await strut.stylize(motion, db, { styles: { proud: 1 }, k: 40, rho: 0.7, onProgress, signal });
  const root = new THREE.Group();
  const names = ${JSON.stringify(ROLES)};
  const joints = names.map((name) => Object.assign(new THREE.Object3D(), { name }));
  ${JSON.stringify(PARENTS)}.forEach((parent, i) => (parent < 0 ? root : joints[parent]).add(joints[i]));
  const clip = result.toAnimationClip(THREE, root);
  const live = await strut.createStylizer(db, options);
  const poses = (await motion.poses(db)).slice(0, 87 * 20);
  const before = await live.push(poses);
  live.reset();
  live.setStyles({ proud: 0.5, old: 0.5 }); const styled = await live.push(poses);
  strut.dispose();
  return {
    thread: strut.thread,
    frames: motion.frames,
    bvh: result.toBVH(),
    parts: {
      trace: result.trace.length,
      glb: new TextDecoder().decode(result.toGLB().subarray(0, 4)),
      clip: { tracks: clip.tracks.length, valid: clip.validate() },
      live: { frames: styled.poses.length / 87, changed: styled.poses.some((value, i) => value !== before.poses[i]) },
      progress: progress > 0,
    },
  };
})();
window.said.catch(() => {});
`;

test("by import map, with no build", async () => {
  expectSame(await open(siteWithPackage("import-map")), "worker");
});

test("does all of the contract of DESIGN.md", async () => {
  const folder = site("contract", {
    "index.html": `<!doctype html><script type="importmap">${JSON.stringify({
      imports: { "strut-motion": "./strut-motion/index.js", three: "./three/three.module.js" },
    })}</script><script type="module" src="main.js"></script>`,
    "main.js": CONTRACT,
  });
  copyPackage(consumer, folder);
  cpSync(join(consumer.folder, "node_modules", "three", "build"), join(folder, "three"), { recursive: true });
  const { parts, ...said } = (await open(folder)) as Said & { parts: Record<string, unknown> };
  expectSame(said, "worker");
  expect(parts).toEqual({
    trace: FRAMES,
    glb: "glTF",
    clip: { tracks: 22, valid: true },
    live: { frames: 20, changed: true },
    progress: true,
  });
});

test("built by Vite without configuration", async () => {
  const folder = site("vite", { "index.html": html("/main.js"), "main.js": program() });
  const dist = join(folder, "dist");
  await vite({ root: folder, configFile: false, logLevel: "error", build: { outDir: dist } });
  copyData(consumer, dist);
  expectSame(await open(dist), "worker");
});

test("served by Vite in development without configuration", async () => {
  const root = site("vite-dev", { "index.html": html("/main.js"), "main.js": program(), "package.json": "{}" });
  // Vite serves a separate project, and no files outside of it.
  cpSync(consumer.installed, join(root, "node_modules", "strut-motion"), { recursive: true });
  const server = await createServer({ root, configFile: false, logLevel: "error", server: { port: 0 } });
  try {
    await server.listen();
    expectSame((await visitPage(browser, server.resolvedUrls!.local[0]!)).said, "worker");
  } finally {
    await server.close();
  }
});

test("bundled by esbuild, the assets copied beside the bundle", async () => {
  const folder = await siteByEsbuild("esbuild");
  cpSync(join(consumer.installed, "assets"), join(folder, "assets"), { recursive: true });
  expectSame(await open(folder), "worker");
});

test("bundled by esbuild, told where the assets are", async () => {
  const folder = await siteByEsbuild("esbuild-assets", '{ assets: "/files" }');
  cpSync(join(consumer.installed, "assets"), join(folder, "files"), { recursive: true });
  expectSame(await open(folder), "worker");
});

test("from another origin that allows it, in a worker from a blob", async () => {
  const folder = site("elsewhere", {
    "index.html": html("main.js", `${elsewhere.url}/index.js`),
    "main.js": program(),
  });
  expectSame(await open(folder), "blob");
});

test("in a sandboxed frame without an origin, its files served with CORS", async () => {
  const folder = siteWithPackage("sandboxed");
  cpSync(join(folder, "index.html"), join(folder, "frame.html"));
  site("sandboxed", { "index.html": '<!doctype html><iframe sandbox="allow-scripts" src="frame.html"></iframe>' });
  expectSame(await open(folder, CORS, true), "blob");
});

/** Makes a page that imports a module as text from a blob, as notebooks do. */
const siteOfBlob = (name: string, module: string) =>
  site(name, {
    "index.html": html("main.js"),
    "module.js": module,
    "main.js": `const blobOf = (text) => URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
const source = blobOf(await (await fetch("/module.js")).text());
await import(blobOf(${JSON.stringify(program("SOURCE"))}.replace("SOURCE", source)));
`,
  });

test("in one file, imported from a blob", async () => {
  const module = readFileSync(join(consumer.installed, "inline.js"), "utf8");
  expectSame(await open(siteOfBlob("inline", module)), "blob");
});

test("bundled and imported from a blob it says what to import instead", async () => {
  const { outputFiles } = await esbuild({
    entryPoints: [join(consumer.installed, "index.js")],
    bundle: true,
    format: "esm",
    write: false,
  });
  const folder = siteOfBlob("blob", outputFiles[0]!.text);
  await expect(open(folder)).rejects.toThrow(/The location of the engine's files is unknown/);
});

test("on the page's thread where it may have no worker", async () => {
  expectSame(await open(siteWithPackage("no-worker", "{ worker: false }")), "page");
});

test("under a Content-Security-Policy and with Trusted Types", async () => {
  const folder = site("policy", { "index.html": html("main.js"), "main.js": program("./strut-motion/index.js") });
  copyPackage(consumer, folder);
  const policy = [
    "default-src 'none'",
    "script-src 'self' 'wasm-unsafe-eval'",
    "worker-src 'self'",
    "connect-src 'self'",
    "trusted-types strut-motion",
    "require-trusted-types-for 'script'",
  ].join("; ");
  expectSame(await open(folder, { "Content-Security-Policy": policy }), "worker");
  // The same page, but without any workers.
  const none = policy.replace("worker-src 'self'", "worker-src 'none'");
  expectSame(await open(folder, { "Content-Security-Policy": none }), "page");
});

test("in a worker whose own policy lets it fetch nothing, which the page sends the files", async () => {
  const folder = siteWithPackage("sent");
  const main = program().replaceAll('"/demo.strutdb"', '"strut:walk"');
  writeFileSync(join(folder, "main.js"), main);
  const nothing = "script-src 'wasm-unsafe-eval'; connect-src 'none'";
  const headers = (path: string): Record<string, string> =>
    path.endsWith("/worker.js") ? { "Content-Security-Policy": nothing } : {};
  const said = await open(folder, headers);
  expect(said).toMatchObject({ thread: "worker", frames: FRAMES });
  expect(said.bvh).toBe(styledByNode(consumer));
});

/** Exports the mannequin to a file, and loads it again as a character. */
const CHARACTER = `import { loadStrut } from "strut-motion";
import { loadCharacter } from "strut-motion/three";
window.said = (async () => {
  const strut = await loadStrut();
  const db = await strut.openDatabase("/demo.strutdb");
  const motion = await strut.openMotion("/walk.bvh");
  const styled = await strut.stylize(motion, db, { styles: { proud: 1 } });
  const character = await loadCharacter(new Blob([styled.toGLB()]));
  character.setBody(db.info.proportions);
  character.apply(styled.poses.subarray(0, 87));
  strut.dispose();
  const { roles, object } = character;
  object.updateMatrixWorld(true);
  const { x, y, z } = object.getObjectByName(roles.hips).matrixWorld.elements.reduce(
    (at, value, i) => ({ ...at, ...({ 12: { x: value }, 13: { y: value }, 14: { z: value } })[i] }), {});
  const [X, Y, Z] = styled.poses;
  return {
    thread: strut.thread,
    frames: motion.frames,
    bvh: styled.toBVH(),
    roles: Object.keys(roles).length,
    farMm: 1000 * Math.hypot(x - X, y - Y, z - Z),
  };
})();
window.said.catch(() => {});
`;

test.each(["esbuild", "Vite"])("with a character of three.js, bundled by %s without three-vrm", async (bundler) => {
  const folder = site(`character-${bundler}`, { "index.html": html("/main.js"), "main.js": CHARACTER });
  const dist = join(folder, "dist");
  if (bundler === "Vite") await vite({ root: folder, configFile: false, logLevel: "error", build: { outDir: dist } });
  else {
    const entryPoints = [join(folder, "main.js")];
    await esbuild({ entryPoints, outfile: join(dist, "main.js"), bundle: true, format: "esm", logLevel: "error" });
    cpSync(join(folder, "index.html"), join(dist, "index.html"));
    cpSync(join(consumer.installed, "assets"), join(dist, "assets"), { recursive: true });
  }
  copyData(consumer, dist);
  const { roles, farMm, ...said } = (await open(dist)) as Said & { roles: number; farMm: number };
  expectSame(said, "worker");
  expect(roles).toBe(21);
  expect(farMm).toBeLessThan(0.1);
});

/** Uses of each of the package's files; the main thread replaces a missing worker. */
const USES = `import { loadStrut } from "strut-motion";
import { bindCharacter, loadCharacter } from "strut-motion/three";
import * as THREE from "three";
const clips = async () => Promise.all(["neutral", "old"].map(async (style) => {
  const name = "walk_" + style + "_001.bvh";
  return new File([await (await fetch("/clips/" + name)).blob()], name);
}));
const bones = () => {
  const chain = Array.from({ length: 21 }, () => new THREE.Bone());
  for (const [i, bone] of chain.entries()) if (i > 0) { bone.position.y = 0.1; chain[i - 1].add(bone); }
  const mesh = new THREE.SkinnedMesh(new THREE.BoxGeometry(), new THREE.MeshBasicMaterial());
  const { count } = mesh.geometry.attributes.position;
  mesh.geometry.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(new Uint16Array(4 * count), 4));
  mesh.geometry.setAttribute("skinWeight", new THREE.Float32BufferAttribute(new Float32Array(4 * count).fill(0.25), 4));
  mesh.add(chain[0]);
  mesh.bind(new THREE.Skeleton(chain));
  return mesh;
};
const uses = {
  "worker.js": async (strut) => strut.thread,
  "build_worker.js": async (strut) => strut.openDatabase(await clips()),
  "strut_wasm_bg.wasm": async (strut) => strut.thread,
  "strut_wasm_build_bg.wasm": async (strut) => strut.openDatabase(await clips()),
  "strut_wasm_walk_bg.wasm": (strut) => strut.openWalk("strut:walk"),
  "strut_wasm_key_style_bg.wasm": (strut) => strut.openKeyStyle("strut:walk"),
  "strut_live_bg.wasm": async (strut) => strut.live(await strut.openDatabase("strut:walk"), { start: async () => {} }),
  "strut_wasm_character_bg.wasm": () => bindCharacter(bones()),
  "draco_decoder.wasm": () => loadCharacter("draco.glb"),
  "walk.bin": (strut) => strut.openDatabase("strut:walk"),
  "built_in.bin": (strut) => strut.openDatabase("strut:built-in"),
  "other origin": (strut) => strut.openMotion(OTHER + "/walk.bvh"),
};
window.use = async (file) => {
  let strut;
  try {
    strut = await loadStrut();
    const made = await uses[file](strut);
    return "done on " + (file === "worker.js" ? made : strut.thread);
  } catch ({ code, message, hint }) {
    return code + ": " + message + (hint ? "" : " There is no hint.");
  } finally {
    strut?.dispose();
  }
};
`;

test("without one of its files it says which one, and another origin that does not allow it is said to be one", async () => {
  const other = await serveFolder(consumer.folder);
  const folder = site("missing", {
    "index.html": `<!doctype html><script type="importmap">${JSON.stringify({
      imports: {
        "strut-motion": "./strut-motion/index.js",
        "strut-motion/three": "./strut-motion/three.js",
        three: "./three/three.module.js",
        "three/addons/": "./three/addons/",
      },
    })}</script><script type="module" src="main.js"></script>`,
    "main.js": USES.replace("OTHER", JSON.stringify(other.url)),
  });
  copyPackage(consumer, folder);
  for (const part of ["clips", "node_modules/three/build"])
    cpSync(join(consumer.folder, part), join(folder, part.includes("three") ? "three" : part), { recursive: true });
  for (const part of ["loaders/GLTFLoader.js", "utils"])
    cpSync(join(consumer.folder, "node_modules/three/examples/jsm", part), join(folder, "three/addons", part), {
      recursive: true,
    });
  cpSync(join(root, "tests/rigs/mixamo_draco.glb"), join(folder, "draco.glb"));
  const server = await serveFolder(folder);
  try {
    const page = await browser.newPage();
    await page.goto(server.url);
    await page.waitForFunction(() => "use" in window);
    const use = (file: string) => page.evaluate((name) => window.use(name), file);
    const assets = join(folder, "strut-motion", "assets");
    // `walk.bin.js` is for iframes of the script tag, which `element.test.ts` tests.
    for (const file of readdirSync(assets).filter((name) => name !== "walk.bin.js")) {
      renameSync(join(assets, file), join(folder, file));
      const said = await use(file);
      renameSync(join(folder, file), join(assets, file));
      if (file === "worker.js") expect(said).toBe("done on page");
      else {
        expect(said).toMatch(/^load: .*\.$/);
        expect(said).toContain(file);
      }
    }
    const blocked = await use("other origin");
    expect(blocked).toMatch(
      /^load: The motion .*\/walk.bvh could not be loaded: .*does not allow this page.*\(CORS\)\.$/,
    );
    await page.context().close();
  } finally {
    await server.close();
    await other.close();
  }
});
