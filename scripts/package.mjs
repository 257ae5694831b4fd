// The package `strut-motion` in dist/package/, ready for `npm pack`: entries, worker, modules, data, types.
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { deflateRawSync, gzipSync } from "node:zlib";
import { root, run, Sentence } from "./steps.mjs";

const OUT = join(root, "dist", "package");
const SOURCE = join(root, "web", "package");
const ENGINE = join(root, "web", "engine");

/** Modules that users import. */
const ENTRIES = ["index", "three", "element", "streams", "node", "inline"];

/** Files that the entries load at run time. */
const ASSETS = {
  "strut_wasm_bg.wasm": join(ENGINE, "embed", "pkg", "strut_wasm_bg.wasm"),
  "strut_wasm_build_bg.wasm": join(ENGINE, "build", "pkg", "strut_wasm_build_bg.wasm"),
  "strut_wasm_walk_bg.wasm": join(ENGINE, "walk", "pkg", "strut_wasm_walk_bg.wasm"),
  "strut_wasm_key_style_bg.wasm": join(ENGINE, "key_style", "pkg", "strut_wasm_key_style_bg.wasm"),
  "strut_wasm_character_bg.wasm": join(ENGINE, "character", "pkg", "strut_wasm_character_bg.wasm"),
  "draco_decoder.wasm": join(root, "node_modules/three/examples/jsm/libs/draco/gltf/draco_decoder.wasm"),
  "strut_live_bg.wasm": join(ENGINE, "live", "pkg", "strut_live_bg.wasm"),
  "walk.bin": join(ENGINE, "motions", "walk.bin"),
  // The package starts with all walks.
  "built_in.bin": join(ENGINE, "motions", "besides_walk.bin"),
};

/**
 * Greatest sizes after gzip, kilobytes. They include the reading of varied skeletons: names of joints, floor, axes,
 * sides, cuts and notes. Reports on the reading and reading options take 1.3 kB of the worker and 3 of the module;
 * bodies with other roots or far from the origin, other encodings and notes on styled clips 10. Feet that are children
 * of the root, and the questions about missing joints, take 7 of the modules of characters and of live streams; checks
 * of motions that could not be written or read again take 2 of the module.
 */
const BUDGET_KB = {
  "index.js": 14,
  "element.js": 50,
  "strut-player.js": 558,
  // three.js with its loaders, three-vrm and the module of characters, in one file instead of chunks.
  "strut-character.js": 330,
  // Work that several calls share takes 0.2.
  "assets/worker.js": 14,
  "assets/strut_wasm_bg.wasm": 334,
  "assets/strut_wasm_character_bg.wasm": 103,
  // Only for files that are compressed with Draco.
  "assets/draco_decoder.wasm": 64,
  "streams.js": 4,
  "assets/strut_live_bg.wasm": 146,
};

/** Peer dependencies, and their compatible versions. */
const PEERS = { three: ">=0.180 <0.188", "@pixiv/three-vrm": ">=3" };

/** Output of wasm-bindgen for browsers without WASM SIMD, and for syntax that is not used here. */
const NEEDLESS_GLUE = [
  /^if \(Symbol\.dispose\) .*$/gm,
  /\(typeof FinalizationRegistry === 'undefined'\)\s*\? .*\s*: (?=new FinalizationRegistry)/g,
  /^if \(!\('encodeInto' in cachedTextEncoder\)\) \{[\s\S]*?^\}$/gm,
];

/**
 * Bundlers of the package's users look for `new URL(…, import.meta.url)`. Only the entries may have it: all other
 * modules receive the addresses of files (`web/engine/assets.ts`), and their default addresses would be broken.
 */
const OWN_ADDRESSES_ONLY = {
  name: "own addresses only",
  setup({ onLoad }) {
    onLoad({ filter: /web\/(engine|client)\/.*\.(ts|js)$/ }, ({ path }) => ({
      contents: NEEDLESS_GLUE.reduce((source, needless) => source.replace(needless, ""), readFileSync(path, "utf8"))
        .replaceAll("import.meta.url", '"strut:nowhere"')
        // wasm-bindgen's own loader; `web/engine/module.ts` replaces it.
        .replace("export { initSync, __wbg_init as default };", "export { initSync };"),
      loader: path.endsWith(".ts") ? "ts" : "js",
    }));
  },
};

/** The engine without the parts that only the playground shows. */
const EMBEDDED_ENGINE = {
  name: "embedded engine",
  setup({ onResolve }) {
    onResolve({ filter: /^\.\/pkg\/strut_wasm\.js$/ }, () => ({ path: join(ENGINE, "embed", "pkg", "strut_wasm.js") }));
  },
};

/**
 * Only Node reads files from disk, and the engine hides the module that reads them from the site's bundler. Other
 * bundlers react to the hidden import: webpack warns, and Vite in development turns a worker with `import()` into a
 * module worker, which does not start.
 * @param module the module, or `undefined` in browsers
 */
const readsWith = (module) => ({
  name: "reads with",
  setup({ onLoad }) {
    onLoad({ filter: /web\/engine\/download\.ts$/ }, ({ path }) => {
      const source = readFileSync(path, "utf8");
      const hidden = /await import\([^)]*\)/;
      if (!hidden.test(source)) throw new Error(`${path} has no import that could be replaced`);
      const shown = module === undefined ? "undefined" : `await import("${module}")`;
      return { contents: source.replace(hidden, shown), loader: "ts" };
    });
  },
});

/**
 * Writes assets into an entry: modules as deflated bytes, which `web/package/inflate.ts` inflates; scripts as text.
 * @param deflate compresses a module
 */
const inlined = (deflate) => ({
  name: "inlined assets",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^strut-inline:/ }, ({ path }) => ({
      path: path.slice("strut-inline:".length),
      namespace: "inlined",
    }));
    onLoad({ filter: /.*/, namespace: "inlined" }, async ({ path }) => {
      const contents = readFileSync(join(OUT, "assets", path));
      // Base-64 text is hardly compressible; compression before the encoding saves a quarter.
      return path.endsWith(".js")
        ? { contents, loader: "text" }
        : { contents: await deflate(contents), loader: "binary" };
    });
  },
});

/** Deflates with the best compression, a twentieth better than zlib; equal bytes are deflated once. */
async function deflateBest(bytes) {
  // A clean checkout installs it only after this file is read.
  const { default: zopfli } = await import("@gfx/zopfli");
  const last = deflatedBytes.find(({ from }) => from.equals(bytes));
  if (last) return last.to;
  const to = await zopfli.deflateAsync(bytes, { numiterations: 5 });
  deflatedBytes.push({ from: bytes, to });
  return to;
}
const deflatedBytes = [];

/** Style sheets as text. The entry of the element imports that of the engine instead of including it again. */
const ELEMENT = {
  name: "element",
  setup({ onResolve, onLoad, esbuild }) {
    onResolve({ filter: /\.css\?inline$/ }, ({ path, resolveDir }) => ({
      path: join(resolveDir, path.replace(/\?inline$/, "")),
      namespace: "sheet",
    }));
    onLoad({ filter: /.*/, namespace: "sheet" }, async ({ path }) => ({
      contents: (await esbuild.transform(readFileSync(path, "utf8"), { loader: "css", minify: true })).code,
      loader: "text",
    }));
    onResolve({ filter: /^\.\/index$/ }, ({ importer }) =>
      importer === join(SOURCE, "element.ts") ? { path: "./index.js", external: true } : undefined,
    );
  },
};

/** Omits models that no player trains or opens, and performers, from its script. */
const NO_MODELS = {
  name: "no models",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /\/(models\/(walk|key_style)|streams\/live)$/ }, ({ path }) => ({
      path,
      namespace: "left out",
    }));
    onLoad({ filter: /.*/, namespace: "left out" }, () => ({
      contents: "export const openWalk = undefined, openKeyStyle = undefined, openLive = undefined;",
    }));
  },
};

const COMMON = {
  bundle: true,
  minify: true,
  target: "es2022",
  logLevel: "warning",
  absWorkingDir: root,
};

/**
 * Writes dist/package/ from the built WASM packages.
 * @param mode `full`: modules inside scripts are compressed as well as possible, which takes ten seconds; `quick`: by zlib
 */
export async function writePackage({ mode }) {
  // A clean checkout installs it only after this file is read.
  const { build } = await import("esbuild");
  const manifest = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
  const inlines = inlined(mode === "full" ? deflateBest : deflateRawSync);
  const inBrowsers = {
    platform: "browser",
    plugins: [readsWith(undefined), EMBEDDED_ENGINE, OWN_ADDRESSES_ONLY, inlines, ELEMENT],
  };
  const inNode = {
    platform: "node",
    plugins: [readsWith("node:fs/promises"), EMBEDDED_ENGINE, OWN_ADDRESSES_ONLY, inlines],
  };
  const common = {
    ...COMMON,
    ...inBrowsers,
    define: {
      STRUT_VERSION: JSON.stringify(manifest.version),
      STRUT_SITE: JSON.stringify(process.env.STRUT_SITE_URL ?? ""),
    },
  };
  rmSync(OUT, { recursive: true, force: true });
  mkdirSync(join(OUT, "assets"), { recursive: true });
  for (const [name, path] of Object.entries(ASSETS)) cpSync(path, join(OUT, "assets", name));
  await build({
    ...common,
    entryPoints: ["worker", "build_worker"].map((name) => join(SOURCE, `${name}.ts`)),
    outdir: join(OUT, "assets"),
    format: "iife",
    // Warnings of wasm-bindgen about a deprecated way to call its functions.
    pure: ["console.warn"],
  });
  await build({
    ...common,
    entryPoints: ["index", "three", "element", "streams"].map((name) => join(SOURCE, `${name}.ts`)),
    outdir: OUT,
    external: Object.keys(PEERS),
    format: "esm",
    splitting: true,
    chunkNames: "chunks/[name]-[hash]",
  });
  // A classic script in one file: no other file can be missing, and iframes without an origin can run it.
  await build({
    ...common,
    entryPoints: { "strut-character": join(SOURCE, "strut_character.ts") },
    outdir: OUT,
    format: "iife",
  });
  for (const [entry, source] of Object.entries({ node: "node", inline: "inline", three_node: "three" }))
    await build({
      ...common,
      ...(entry === "inline" ? {} : inNode),
      ...(source === "three" ? { external: Object.keys(PEERS) } : {}),
      entryPoints: [join(SOURCE, `${source}.ts`)],
      outfile: join(OUT, `${entry}.js`),
      format: "esm",
    });
  await build({
    ...common,
    plugins: [...inBrowsers.plugins, NO_MODELS],
    entryPoints: [join(SOURCE, "strut_player.ts")],
    outfile: join(OUT, "strut-player.js"),
    format: "iife",
  });
  cpSync(ASSETS["walk.bin"], join(OUT, "walk.bin"));
  const walk = readFileSync(ASSETS["walk.bin"]).toString("base64");
  for (const folder of [OUT, join(OUT, "assets")])
    writeFileSync(join(folder, "walk.bin.js"), `strutReceive("${walk}");\n`);
  await writeTypes();
  // Imported late like esbuild, which it uses.
  const { readTables, manifestOf: elementManifest, jsxTypesOf } = await import("./element_manifest.mjs");
  const tables = await readTables();
  writeFileSync(join(OUT, "custom-elements.json"), `${JSON.stringify(elementManifest(tables), null, 2)}\n`);
  writeFileSync(join(OUT, "jsx.d.ts"), jsxTypesOf(tables));
  for (const name of ["LICENSE", "LICENSE-MIT", "LICENSE-APACHE"]) cpSync(join(root, name), join(OUT, name));
  cpSync(join(SOURCE, "README.md"), join(OUT, "README.md"));
  writeFileSync(join(OUT, "package.json"), `${JSON.stringify(manifestOf(manifest), null, 2)}\n`);
}

/** Returns the GitHub repository that builds the package, which must match npm's provenance. */
function repositoryOf({ GITHUB_SERVER_URL: server, GITHUB_REPOSITORY: name }) {
  return server && name ? { repository: { type: "git", url: `git+${server}/${name}.git` } } : {};
}

/** Returns the manifest for npm and bundlers. `types` comes first, since the first matching condition is used. */
function manifestOf({ name, version, description, license, engines }) {
  const entry = (module) => ({ types: `./types/package/${module}.d.ts`, default: `./${module}.js` });
  return {
    name,
    version,
    description,
    license,
    ...repositoryOf(process.env),
    type: "module",
    engines,
    sideEffects: ["./element.js", "./strut-player.js"],
    peerDependencies: PEERS,
    peerDependenciesMeta: Object.fromEntries(Object.keys(PEERS).map((peer) => [peer, { optional: true }])),
    exports: {
      ".": { types: "./types/package/index.d.ts", node: "./node.js", default: "./index.js" },
      // In Node files are read, not fetched.
      "./three": {
        types: "./types/package/three.d.ts",
        node: "./three_node.js",
        default: "./three.js",
      },
      "./node": entry("node"),
      "./inline": entry("inline"),
      "./element": entry("element"),
      "./streams": entry("streams"),
      "./jsx": { types: "./jsx.d.ts" },
      "./strut-player.js": "./strut-player.js",
      "./assets/*": "./assets/*",
      "./package.json": "./package.json",
    },
    customElements: "custom-elements.json",
  };
}

/**
 * Writes the declarations of the entries and of all their imports, with the extensions that Node's resolution requires.
 */
async function writeTypes() {
  const all = join(OUT, "all-types");
  const config = join(SOURCE, "tsconfig.types.json");
  await run(process.execPath, [join(root, "node_modules", "typescript", "bin", "tsc"), "-p", config, "--outDir", all]);
  const files = new Set(ENTRIES.map((entry) => join(all, "package", `${entry}.d.ts`)));
  // The set grows during the iteration.
  for (const file of files) {
    // wasm-bindgen's declarations are not compiled; they are next to the sources.
    const declared = existsSync(file) ? file : join(root, "web", relative(all, file));
    // Users need not have the library that declares `Symbol.dispose`.
    const source = readFileSync(declared, "utf8").replace(/^\s*\[Symbol\.dispose\]\(\): void;\n/gm, "");
    const text = source.replace(/(from |import\()"(\.[^"]*?)(?:\.js)?"/g, (_, keyword, path) => {
      const isFolder = existsSync(join(dirname(file), path, "index.d.ts"));
      const named = isFolder ? `${path}/index` : path;
      files.add(join(dirname(file), `${named}.d.ts`));
      return `${keyword}"${named}.js"`;
    });
    const written = join(OUT, "types", relative(all, file));
    mkdirSync(dirname(written), { recursive: true });
    writeFileSync(written, text);
  }
  rmSync(all, { recursive: true });
}

/** Checks the sizes. Returns a message, or throws one if a size exceeds its budget. */
export function checkPackageSize() {
  const sizes = Object.entries(BUDGET_KB).map(([file, budget]) => ({
    file,
    kb: gzipSync(readFileSync(join(OUT, file))).length / 1000,
    budget,
  }));
  const report = sizes.map(({ file, kb, budget }) => `${file} ${kb.toFixed(1)} of ${budget} kB gzip`).join(", ");
  if (sizes.some(({ kb, budget }) => kb > budget)) throw new Sentence(`The package is too large: ${report}.`);
  return report;
}
