// Tests each artefact as a new user has it: installed into an empty folder, it styles one clip; all must write the same
// bytes.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { programIn, setupPython } from "../python_environment.mjs";
import { setupRust } from "../setup.mjs";
import { findProgram, Sentence, step } from "../steps.mjs";
import { CRATES, findArtefact } from "./artefacts.mjs";
import { currentVersion } from "./versions.mjs";

const STYLE = "proud";
const WEIGHT = 0.7;
const TARBALL = /^strut-\d.*\.tar\.gz$/;

const run = (program, args, options = {}) =>
  execFileSync(program, args, { stdio: ["ignore", "ignore", "inherit"], ...options });
const digest = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");
const stylized = (input, out) => [
  "stylize",
  "--db",
  input.db,
  "--input",
  input.clip,
  "--style",
  `${STYLE}=${WEIGHT}`,
  "-o",
  out,
];

/** Unpacks the command of an archive and returns its path. */
function unpackCommand(archive, folder) {
  run("tar", ["-xzf", archive, "-C", folder, "--strip-components=1"]);
  return join(folder, process.platform === "win32" ? "strut.exe" : "strut");
}

/** Returns the output of the command. */
async function byCommand(archive, folder, input) {
  run(unpackCommand(archive, folder), stylized(input, "out.bvh"), { cwd: folder });
}

/** Returns the output of the package that pip installs into an empty environment, with only numpy as dependency. */
async function byPython(archive, folder, input) {
  const python = await setupPython("Python package");
  if (!python) throw new Sentence("Trying the Python package needs Python 3.11 or newer with its module venv.");
  const environment = join(folder, "venv");
  run(python, ["-m", "venv", environment]);
  const { PATH } = await setupRust();
  const inEnvironment = (args) =>
    run(programIn(environment, "python"), args, { cwd: folder, env: { ...process.env, PATH } });
  inEnvironment(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", archive]);
  const script = [
    "import strut, sys",
    "db, clip = strut.Database.open(sys.argv[1]), strut.Motion.open(sys.argv[2])",
    `strut.stylize(clip, db, {"${STYLE}": ${WEIGHT}}).save("out.bvh")`,
  ];
  inEnvironment(["-c", script.join("\n"), input.db, input.clip]);
}

/** Returns the output in Node of the package that npm installs into an empty folder. */
async function byNpm(archive, folder, input) {
  writeFileSync(join(folder, "package.json"), '{ "private": true, "type": "module" }\n');
  run("npm", ["install", "--silent", "--no-audit", "--no-fund", archive], { cwd: folder });
  const script = `
    import { readFileSync, writeFileSync } from "node:fs";
    import { loadStrut } from "strut-motion";
    const strut = await loadStrut();
    const bytes = (path) => new Uint8Array(readFileSync(path)).buffer;
    const [db, clip] = process.argv.slice(2);
    const database = await strut.openDatabase(bytes(db));
    const motion = await strut.openMotion(bytes(clip));
    const result = await strut.stylize(motion, database, { styles: { ${STYLE}: ${WEIGHT} } });
    writeFileSync("out.bvh", result.toBVH());
    strut.dispose();
  `;
  writeFileSync(join(folder, "style.mjs"), script);
  run(process.execPath, ["style.mjs", input.db, input.clip], { cwd: folder });
}

/**
 * Returns the output of the command that cargo installs from the crates. Local crates replace those that are not
 * published yet.
 */
async function byCrates(archives, folder, input) {
  const rust = await setupRust();
  for (const archive of archives) run("tar", ["-xzf", archive, "-C", folder]);
  const unpacked = (name) => join(folder, `${name}-${currentVersion()}`);
  const patches = CRATES.slice(0, -1).flatMap((name) => [
    "--config",
    `patch.crates-io.${name}.path="${unpacked(name)}"`,
  ]);
  const cli = CRATES.at(-1);
  run(rust.CARGO ?? "cargo", ["install", "--quiet", "--root", folder, "--path", unpacked(cli), ...patches], {
    cwd: folder,
    env: { ...process.env, ...rust, CARGO_TARGET_DIR: join(folder, "target") },
  });
  run(join(folder, "bin", "strut"), stylized(input, "out.bvh"), { cwd: folder });
}

const TRIED = [
  { label: "the command", pattern: TARBALL, styles: byCommand },
  { label: "the wheel", pattern: /\.whl$/, styles: byPython },
  { label: "Python's source distribution", pattern: /^strut_motion-.*\.tar\.gz$/, styles: byPython },
  { label: "npm's package", pattern: /\.tgz$/, styles: byNpm },
];

/**
 * Installs every artefact of a folder and compares its output for one clip with the command's.
 * @throws a {@link Sentence} if they differ, or the command is missing
 */
export async function tryArtefacts(artefacts) {
  const folder = mkdtempSync(join(tmpdir(), "strut-try-"));
  const roomFor = (name) => {
    const room = join(folder, name);
    mkdirSync(room);
    return room;
  };
  try {
    const archive = findArtefact(artefacts, TARBALL);
    if (!archive) throw new Sentence(`There is no archive of the command in ${artefacts}.`);
    const strut = unpackCommand(archive, roomFor("input"));
    const input = { db: join(folder, "demo.strutdb"), clip: join(folder, "clips", "walk_neutral_001.bvh") };
    run(strut, ["demo-db", "--page", "-o", input.db, "--bvh", join(folder, "clips")], { cwd: folder });
    const expected = join(folder, "expected.bvh");
    run(strut, stylized(input, expected), { cwd: folder });
    const same = (room, label) => {
      const written = digest(join(room, "out.bvh"));
      if (written !== digest(expected)) throw new Sentence(`The output of ${label} differs from that of the command.`);
      return written.slice(0, 16);
    };
    for (const [i, { label, pattern, styles }] of TRIED.entries()) {
      const found = findArtefact(artefacts, pattern);
      if (!found) console.log(`▸ ${label}: not in ${artefacts}`);
      else
        await step(`Styling a clip with ${label}`, async () => {
          const room = roomFor(String(i));
          await styles(found, room, input);
          return same(room, label);
        });
    }
    const crates = CRATES.map((name) => findArtefact(artefacts, new RegExp(`^${name}-\\d.*\\.crate$`)));
    if (crates.every(Boolean) && findProgram("cargo"))
      await step("Styling a clip with the command of the crates", async () => {
        const room = roomFor("crates");
        await byCrates(crates, room, input);
        return same(room, "the command of the crates");
      });
  } finally {
    rmSync(folder, { recursive: true });
  }
}
