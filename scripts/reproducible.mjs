// npm run reproducible: checks that equal sources give equal bytes. Builds the site in two clones of HEAD, in folders
// of different names and without caches, and compares all files of dist/. Takes the time of two builds, and is not part
// of the tests.
import { createHash } from "node:crypto";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { main, root, run, Sentence, step } from "./steps.mjs";

/** Greatest number of differing files that are listed. */
const NAMED = 20;

/** Builds the site in a clone. Returns the SHA-256 of each of its files, by path. */
async function cleanBuild(folder) {
  await run("git", ["clone", "--quiet", root, folder]);
  await run(process.execPath, [join(folder, "scripts", "build.mjs")], {
    cwd: folder,
    env: { STRUT_BUILD_CACHE: "off" },
  });
  const site = join(folder, "dist");
  const files = readdirSync(site, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile());
  const paths = files.map(({ parentPath, name }) => join(parentPath, name)).sort();
  return new Map(paths.map((path) => [relative(site, path), sha256(readFileSync(path))]));
}

const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");

await main(async () => {
  const folder = mkdtempSync(join(tmpdir(), "strut-reproducible-"));
  try {
    const first = await cleanBuild(join(folder, "one"));
    const second = await cleanBuild(join(folder, "another-one"));
    const paths = [...new Set([...first.keys(), ...second.keys()])];
    await step("Comparing the two builds", () => {
      const other = paths.filter((path) => first.get(path) !== second.get(path));
      if (other.length > 0) {
        const more = other.length > NAMED ? ", …" : "";
        throw new Sentence(
          `${other.length} of ${paths.length} files differ: ${other.slice(0, NAMED).join(", ")}${more}`,
        );
      }
      return `${paths.length} files are the same; all of them: ${sha256([...first].flat().join("\n"))}`;
    });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
