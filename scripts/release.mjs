// npm run release -- …: the version, the artefacts of a release, and their tests (docs/releases.md).
import { createHash } from "node:crypto";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { ARTEFACTS, publishCrates } from "./release/artefacts.mjs";
import { tryArtefacts } from "./release/first_clip.mjs";
import { currentVersion, newestChanges, raiseVersion, tagFaults, versionFaults } from "./release/versions.mjs";
import { main, root, run, Sentence, step } from "./steps.mjs";

const USAGE = `npm run release -- --check [--tag vX.Y.Z]     one version everywhere, and that of the tag
npm run release -- --raise X.Y.Z              write a version everywhere and date the changes
npm run release -- --changes                  print the changes of the newest version
npm run release -- --build KIND[,KIND] [--out DIR]
                                              build artefacts: ${Object.keys(ARTEFACTS).join(", ")} or all
npm run release -- --try DIR                  style one clip with each artefact of a folder
npm run release -- --dry-run TAG [--out DIR]  check, build and try all of a tag, from a fresh clone
npm run release -- --publish-crates           publish the crates on crates.io`;

const OPTIONS = {
  check: { type: "boolean" },
  changes: { type: "boolean" },
  tag: { type: "string" },
  raise: { type: "string" },
  build: { type: "string" },
  try: { type: "string" },
  "dry-run": { type: "string" },
  "publish-crates": { type: "boolean" },
  out: { type: "string", default: join(root, "dist", "release") },
};

/** Refuses versions that differ. */
function check(tag) {
  const faults = [...versionFaults(), ...(tag === undefined ? [] : tagFaults(tag))];
  if (faults.length > 0) throw new Sentence(faults.join("\n"));
  return currentVersion();
}

/** Builds artefacts into a folder, and writes their digests there. */
async function build(kinds, out) {
  const unknown = kinds.find((kind) => !(kind in ARTEFACTS));
  if (unknown !== undefined)
    throw new Sentence(`"${unknown}" is not an artefact. Artefacts: ${Object.keys(ARTEFACTS).join(", ")}.`);
  mkdirSync(out, { recursive: true });
  for (const kind of kinds) await step(`Building ${kind}`, () => ARTEFACTS[kind](out));
  const files = readdirSync(out).filter((name) => name !== "SHA256SUMS");
  const line = (name) =>
    `${createHash("sha256")
      .update(readFileSync(join(out, name)))
      .digest("hex")}  ${name}\n`;
  writeFileSync(join(out, "SHA256SUMS"), files.map(line).join(""));
}

/** Does everything that a release does before publishing, from a fresh clone of a tag. */
async function dryRun(tag, out) {
  const folder = mkdtempSync(join(tmpdir(), "strut-tag-"));
  try {
    await step(`Cloning ${tag}`, () => run("git", ["clone", "--quiet", "--branch", tag, root, folder]));
    const release = (...args) => run(process.execPath, ["scripts/release.mjs", ...args], { cwd: folder });
    await release("--check", "--tag", tag);
    await release("--build", "all", "--out", out);
    await release("--try", out);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Parses the command line; an unknown option prints the usage and ends the program. */
function parse() {
  try {
    return parseArgs({ options: OPTIONS }).values;
  } catch (error) {
    console.error(`error: ${error.message}\n\n${USAGE}`);
    process.exit(2);
  }
}

const options = parse();
const out = resolve(process.env.INIT_CWD ?? ".", options.out);
if (options.changes) console.log(newestChanges());
else if (options.raise) await main(async () => raiseVersion(options.raise, new Date().toISOString().slice(0, 10)));
else if (options.check) await main(() => step("Versions", async () => check(options.tag)));
else if (options.build)
  await main(() => build(options.build === "all" ? Object.keys(ARTEFACTS) : options.build.split(","), out));
else if (options.try) await main(() => tryArtefacts(resolve(process.env.INIT_CWD ?? ".", options.try)));
else if (options["dry-run"]) await main(() => dryRun(options["dry-run"], out));
else if (options["publish-crates"]) await main(publishCrates);
else {
  console.error(USAGE);
  process.exitCode = 2;
}
