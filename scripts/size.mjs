// The size budget of DESIGN §8: what a visitor loads before the character moves.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { root, Sentence } from "./steps.mjs";

/** Most kilobytes after gzip. */
const BUDGET_KB = { js: 300, wasm: 300, bin: 1500 };

/** What nobody waits for who wants to see the character move: by the beginnings of its files' names. */
const LATER = [
  // bench.html and what only it loads.
  "bench",
  "strut_bench",
  // The other views, and the package that builds databases: loaded when somebody brings clips of their own.
  "data_view",
  "compare_view",
  "walk_view",
  "key_style_view",
  "row_viewer",
  "shelf",
  "outputs",
  "mannequin_glb",
  "build_worker",
  "strut_wasm_build",
  "strut_wasm_walk",
  "strut_wasm_key_style",
  // What only the Compare view loads: trained methods and counterparts.
  "compare_worker",
  "strut_compare",
];

/** Checks dist/; a sentence for people is returned, or thrown where the budget is exceeded. */
export function checkSize() {
  const assets = join(root, "dist", "assets");
  if (!existsSync(assets)) throw new Sentence("dist/ is missing; run 'npm run build' first.");
  const sizes = Object.keys(BUDGET_KB).map((ending) => {
    const files = readdirSync(assets).filter(
      (file) => file.endsWith(`.${ending}`) && !LATER.some((name) => file.startsWith(name)),
    );
    const bytes = files.reduce((sum, file) => sum + gzipSync(readFileSync(join(assets, file))).length, 0);
    return { ending, kb: bytes / 1000, budget: BUDGET_KB[ending] };
  });
  const report = sizes.map(({ ending, kb, budget }) => `${ending} ${kb.toFixed(0)} of ${budget} kB gzip`).join(", ");
  if (sizes.some(({ kb, budget }) => kb > budget)) throw new Sentence(`The size budget is exceeded: ${report}.`);
  return report;
}
