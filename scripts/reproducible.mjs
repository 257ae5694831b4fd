// npm run reproducible [-- --keep]: whether two clean builds of the committed state, in folders of different names, give the same
// bytes. Clones the repository twice into a temporary folder, builds the site and the package in each, and compares every file of
// dist/. Not part of the tests: it takes two full builds. --keep leaves the folders there.
import { createHash } from "node:crypto";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { parseArgs } from "node:util";
import { main, root, run, Sentence, step } from "./steps.mjs";

/** Names of the folders, of different lengths: a path that gets into a file changes its size, too. */
const FOLDERS = ["one", "another-folder"];
/** Differing files that are named. */
const MAX_NAMED = 40;

/** Every file below a folder with its digest, by its path from there. */
function digests(folder) {
  const files = readdirSync(folder, { recursive: true }).map((name) => join(folder, String(name)));
  const digest = (path) => createHash("sha256").update(readFileSync(path)).digest("hex");
  return new Map(files.filter((path) => statSync(path).isFile()).map((path) => [relative(folder, path), digest(path)]));
}

await main(async () => {
  const { values } = parseArgs({ options: { keep: { type: "boolean" } } });
  const parent = mkdtempSync(join(tmpdir(), "strut-builds-"));
  try {
    const built = [];
    for (const name of FOLDERS) {
      const folder = join(parent, name);
      // Nothing is shared: cargo's target folder would hand the first build's results to the second.
      const env = { CARGO_TARGET_DIR: join(folder, "rust", "target") };
      await run("git", ["clone", "--quiet", "--no-local", root, folder]);
      await step(`A clean build in ${folder}`, () => run("npm", ["run", "--silent", "build"], { cwd: folder, env }));
      built.push(digests(join(folder, "dist")));
    }
    const [one, other] = built;
    const paths = [...new Set([...one.keys(), ...other.keys()])].sort();
    const different = paths.filter((path) => one.get(path) !== other.get(path));
    if (different.length > 0) {
      const named = different.slice(0, MAX_NAMED).join("\n  ");
      throw new Sentence(`${different.length} of ${paths.length} files differ:\n  ${named}`);
    }
    console.log(`${paths.length} files of dist/ are the same, byte for byte.`);
  } finally {
    if (values.keep) console.log(`The builds are in ${parent}.`);
    else rmSync(parent, { recursive: true, force: true });
  }
});
