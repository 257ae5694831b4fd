// The size budget of DESIGN §8: what a visitor loads before the character moves.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { basename, extname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { root, Sentence } from "./steps.mjs";

/** Most kilobytes after gzip, by the ending of files. */
const BUDGET_KB = { ".js": 300, ".wasm": 300, ".bin": 1500 };

/**
 * What is loaded when it is asked for: most kilobytes after gzip of a chunk with the scripts and style sheets that come with it
 * and that the page does not have already.
 */
const LATER = [
  { name: "Learn", key: /views\/learn\/learn_view\.ts$/, budget: 60 },
  { name: "figures", key: /element\/figure\/\w+\/\w+_figure\.ts$/, budget: 30 },
  { name: "a lesson", key: /lessons\/(text\/\w+\/)?\w+\.ts$/, budget: 12, sets: withTexts },
];

/** Each lesson with its text in each language. */
function withTexts(keys) {
  const texts = keys.filter((key) => key.includes("/text/"));
  return texts.map((text) => [text, ...keys.filter((key) => !texts.includes(key) && basename(key) === basename(text))]);
}

/** The page, and the module that its first script always imports, dynamically so that it runs in a task of its own. */
const PAGE = ["index.html", "shell/app.ts"];

/** Modules that are loaded with some of it: most kilobytes after gzip. */
const LATER_MODULES = [
  { name: "the lessons' engine", asset: /^strut_learn_bg.*\.wasm$/, budget: 450 },
  { name: "walking", asset: /^strut_wasm_walk_bg.*\.wasm$/, budget: 125 },
  // 150 are specified (`shared/spec/lessons.md` section 3); kiddo and learning by updates are in it.
  { name: "key-styling", asset: /^strut_wasm_key_style_bg.*\.wasm$/, budget: 165 },
];

/** Checks dist/; a sentence for people is returned, or thrown where the budget is exceeded. */
export function checkSize() {
  const dist = join(root, "dist");
  const manifest = join(dist, ".vite", "manifest.json");
  if (!existsSync(manifest)) throw new Sentence("dist/ is missing; run 'npm run build' first.");
  const chunks = JSON.parse(readFileSync(manifest, "utf8"));
  const initial = initialFiles(dist, chunks);
  const sizes = Object.entries(BUDGET_KB).map(([ending, budget]) => {
    const files = initial.filter((file) => extname(file) === ending);
    const bytes = files.reduce((sum, file) => sum + gzipSync(readFileSync(join(dist, file))).length, 0);
    return { ending: ending.slice(1), kb: bytes / 1000, budget };
  });
  const report = sizes.map(({ ending, kb, budget }) => `${ending} ${kb.toFixed(0)} of ${budget} kB gzip`).join(", ");
  if (sizes.some(({ kb, budget }) => kb === 0 || kb > budget))
    throw new Sentence(`The size budget is exceeded: ${report}.`);
  const later = [...laterSizes(dist, chunks, initial), ...moduleSizes(dist)];
  const all = [report, ...later.map(({ name, kb, budget }) => `${name} ${kb.toFixed(1)} of ${budget} kB`)].join(", ");
  if (later.some(({ kb, budget }) => kb === 0 || kb > budget))
    throw new Sentence(`The size budget is exceeded: ${all}.`);
  return all;
}

/** Sizes of {@link LATER_MODULES}. */
function moduleSizes(dist) {
  const assets = readdirSync(join(dist, "assets"));
  return LATER_MODULES.map(({ name, asset, budget }) => {
    const file = assets.find((one) => asset.test(one));
    return { name, kb: file ? gzipSync(readFileSync(join(dist, "assets", file))).length / 1000 : 0, budget };
  });
}

/** The largest chunk, or set of chunks, of each kind of {@link LATER}; what an earlier kind has loaded is not counted again. */
function laterSizes(dist, manifest, initial) {
  const filesWith = (key, seen = new Set()) => {
    if (seen.has(key)) return [];
    seen.add(key);
    const { file, css = [], imports = [] } = manifest[key];
    return [file, ...css, ...imports.flatMap((other) => filesWith(other, seen))];
  };
  const had = new Set(initial);
  const kbOf = (keys) => {
    const files = new Set(keys.flatMap((key) => filesWith(key)).filter((file) => !had.has(file)));
    return [...files].reduce((sum, file) => sum + gzipSync(readFileSync(join(dist, file))).length, 0) / 1000;
  };
  return LATER.map(({ name, key, budget, sets = (keys) => keys.map((one) => [one]) }) => {
    const keys = Object.keys(manifest).filter((one) => key.test(one));
    const kb = Math.max(0, ...sets(keys).map(kbOf));
    for (const file of keys.flatMap((one) => filesWith(one))) had.add(file);
    return { name, kb, budget };
  });
}

/**
 * What the page loads without being asked: {@link PAGE} with all that it imports statically, and the workers, modules and
 * data that these name. Chunks that are imported when a person asks for them are not among it.
 */
function initialFiles(dist, manifest) {
  const chunks = new Set();
  const follow = (key) => {
    if (chunks.has(key)) return;
    chunks.add(key);
    (manifest[key].imports ?? []).forEach(follow);
  };
  PAGE.forEach(follow);
  const later = new Set(
    Object.keys(manifest)
      .filter((key) => !chunks.has(key))
      .map((key) => manifest[key].file)
      // The manifest lists some data too; whether they are loaded is for those to say who name them.
      .filter((file) => [".js", ".css"].includes(extname(file))),
  );
  const files = new Set([...chunks].map((key) => manifest[key].file));
  const assets = readdirSync(join(dist, "assets")).map((name) => `assets/${name}`);
  // A set grows while it is walked: workers name files in turn.
  for (const file of files) {
    if (extname(file) !== ".js") continue;
    const text = readFileSync(join(dist, file), "utf8");
    for (const asset of assets) if (!later.has(asset) && text.includes(basename(asset))) files.add(asset);
  }
  return [...files];
}
