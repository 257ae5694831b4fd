// Checks the size budget: what a visitor loads before the character moves.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { basename, extname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { siteFiles } from "./site_files.mjs";
import { root, Sentence } from "./steps.mjs";

/** Greatest sizes after gzip, kilobytes, by extension, of the files before the first styled figure. */
// The engine of the page's start also measures the distance that a clip travels and its distance from the database. Messages
// that name the next step, and one pass of wasm-opt, take half a kilobyte.
const BUDGET_KB = { ".js": 300, ".wasm": 117, ".bin": 175 };
/**
 * Greatest size after gzip, kilobytes, of all files before the first styled figure. The specification is 600. Handles that
 * trim a motion, cues of panels that scroll, folded settings, and frames that are read back take three more.
 */
const BUDGET_ALL_KB = 603;

/**
 * Files that the page loads once it plays: the whole engine in a separate worker and the other motions, the worker's
 * driving files, and Greek letters for reading.
 */
const AFTERWARDS = /^assets\/(worker-|strut_wasm_bg-|built_in-|driving-|strut_drive_bg-|drive-|inter-greek-)/;

/**
 * Files that are loaded on demand: greatest size after gzip, kilobytes, of a chunk with its additional scripts and
 * style sheets.
 */
const LATER = [
  { name: "Learn", key: /views\/learn\/learn_view\.ts$/, budget: 60 },
  { name: "Crowd", key: /views\/crowd\/crowd_view\.ts$/, budget: 26 },
  { name: "Drive", key: /views\/play\/drive\/driving\.ts$/, budget: 17 },
  { name: "Projects", key: /^project\/projects\.ts$/, budget: 12 },
  { name: "Batches", key: /^batch\/take_motions\.ts$/, budget: 12 },
  { name: "live poses", key: /client\/live\/live_stream\.ts$/, budget: 7 },
  { name: "Live", key: /views\/play\/live\/performance\.ts$/, budget: 9 },
  { name: "figures", key: /figures\/\w+\/\w+_figure\.ts$/, budget: 30 },
  { name: "a lesson", key: /lessons\/(text\/\w+\/)?\w+\.ts$/, budget: 12, sets: withTexts },
];

/** Returns each lesson with its text in each language. */
function withTexts(keys) {
  const texts = keys.filter((key) => key.includes("/text/"));
  return texts.map((text) => [text, ...keys.filter((key) => !texts.includes(key) && basename(key) === basename(text))]);
}

/** Modules and data that are loaded once the page plays, or on demand: greatest sizes after gzip, kilobytes. */
const LATER_ASSETS = [
  // The specification is 300. Reading of varied files (floor, axes, sides, cuts, names, notes) takes 28 more, reports
  // on the reading and reading options 3, bodies with the root at the chest or far from the origin 4, other encodings
  // 6, and the refusal of motions that could not be written or read again 2. The engine of the page's start has none of
  // these.
  { name: "the engine", asset: /^strut_wasm_bg.*\.wasm$/, budget: 354 },
  { name: "all motions", asset: /^built_in-.*\.bin$/, budget: 1325 },
  // Trained methods that the core knows only by an interface, and one pass of wasm-opt, take 5.
  { name: "the lessons' engine", asset: /^strut_learn_bg.*\.wasm$/, budget: 503 },
  // The code that writes BVH files includes names in other encodings.
  { name: "walking", asset: /^strut_wasm_walk_bg.*\.wasm$/, budget: 128 },
  { name: "crowds", asset: /^strut_crowd_bg.*\.wasm$/, budget: 144 },
  // Predictions are checked before they are performed.
  { name: "performers", asset: /^strut_performers_bg.*\.wasm$/, budget: 77 },
  // Jumps from a run take one kilobyte.
  { name: "driving", asset: /^strut_drive_bg.*\.wasm$/, budget: 62 },
  // The suggestion was 60. Joint detection for any sender's body takes 70, as in the package of characters; more names
  // of joints, axes, notes and other encodings 18; feet that are children of the root and lists of missing joints 7.
  { name: "live streams", asset: /^strut_live_bg.*\.wasm$/, budget: 146 },
  { name: "characters that are compressed with Draco", asset: /^draco_decoder.*\.wasm$/, budget: 64 },
  { name: "drawing by a graphics processor", asset: /^strut_wasm_gpu_bg.*\.wasm$/, budget: 65 },
  // The specification is 150; the size includes kiddo and step-by-step training.
  { name: "key-styling", asset: /^strut_wasm_key_style_bg.*\.wasm$/, budget: 168 },
];

/** Checks dist/. Returns a message, or throws one if the budget is exceeded. */
export function checkSize() {
  const dist = join(root, "dist");
  if (!existsSync(join(dist, ".vite", "manifest.json")))
    throw new Sentence("dist/ is missing; run 'npm run build' first.");
  const { manifest, first: initial } = siteFiles(dist);
  const beginning = ["index.html", ...initial.filter((file) => !AFTERWARDS.test(file))];
  const sizeOf = (name, files, budget) => ({ name, kb: gzipKb(dist, files), budget });
  const sizes = [
    ...Object.entries(BUDGET_KB).map(([ending, budget]) =>
      sizeOf(
        ending.slice(1),
        beginning.filter((file) => extname(file) === ending),
        budget,
      ),
    ),
    sizeOf("before the first styled figure", beginning, BUDGET_ALL_KB),
  ];
  const report = sizes.map(({ name, kb, budget }) => `${name} ${kb.toFixed(0)} of ${budget} kB gzip`).join(", ");
  if (sizes.some(({ kb, budget }) => kb === 0 || kb > budget))
    throw new Sentence(`The size budget is exceeded: ${report}.`);
  const later = [...laterSizes(dist, manifest, initial), ...assetSizes(dist)];
  const all = [report, ...later.map(({ name, kb, budget }) => `${name} ${kb.toFixed(1)} of ${budget} kB`)].join(", ");
  if (later.some(({ kb, budget }) => kb === 0 || kb > budget))
    throw new Sentence(`The size budget is exceeded: ${all}.`);
  return all;
}

/** Returns kilobytes of files after gzip; files that do not become smaller are sent uncompressed. */
function gzipKb(dist, files) {
  const sizeOf = (bytes) => Math.min(bytes.length, gzipSync(bytes).length);
  return files.reduce((sum, file) => sum + sizeOf(readFileSync(join(dist, file))), 0) / 1000;
}

/** Returns the sizes of {@link LATER_ASSETS}. */
function assetSizes(dist) {
  const assets = readdirSync(join(dist, "assets"));
  return LATER_ASSETS.map(({ name, asset, budget }) => {
    const file = assets.find((one) => asset.test(one));
    return { name, kb: file ? gzipSync(readFileSync(join(dist, "assets", file))).length / 1000 : 0, budget };
  });
}

/**
 * Returns the largest chunk, or set of chunks, of each kind of {@link LATER}. Files that an earlier kind has loaded are
 * not counted again.
 */
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
