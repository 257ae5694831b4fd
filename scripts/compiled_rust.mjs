// Cache of what cargo compiled for lints and tests, for new clones on this machine. Third-party crates, about half of
// the compilation, are shared by all clones. Our own crates, where CI keeps them, are shared by clones in the same
// folder, since tests contain the paths of their programs and files. cargo itself decides what is up to date.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync, statSync, utimesSync, writeFileSync } from "node:fs";
import { join, relative, sep } from "node:path";
import { isKept, keepBuilt, takeBuilt } from "./build_cache.mjs";
import { output, root } from "./steps.mjs";

const RUST = join(root, "rust");
/** Target folder of lints and tests. */
const TARGET = join(RUST, "target", "debug");
/** File in the target with a hash of each compiled source, by the path below `rust/`. */
const SOURCES = join(TARGET, "sources.json");
/** Folders of a target in which a crate has entries, `name-hash` with an optional prefix and suffix. */
const FOLDERS = [".fingerprint", "build", "deps"];
const PART = "debug";
/** A time before any compilation. */
const LONG_AGO = new Date("2000-01-01");

/** The end of an entry's name: a hash, and in `deps` an extension. */
const HASH = /-([0-9a-f]{16})(\.\w+)?$/;

const compiler = async (env) => (await output(env.RUSTC ?? "rustc", ["-vV"], { env })) ?? "";

/** Returns a hash of what determines which crates are compiled, and how. */
async function keyOfCrates(env) {
  const folders = readdirSync(RUST, { withFileTypes: true }).filter((entry) => entry.isDirectory());
  const manifests = folders.map(({ name }) => join(RUST, name, "Cargo.toml")).filter((path) => existsSync(path));
  const settings = [join(RUST, ".cargo", "config.toml"), join(RUST, "Cargo.toml"), join(RUST, "Cargo.lock")];
  const hash = createHash("sha256");
  for (const path of [...settings, ...manifests.sort()]) hash.update(readFileSync(path)).update("\0");
  return hash.update(await compiler(env)).digest("hex");
}

/** Returns a hash that identifies a target: the folder of the clone, and what determines which crates are compiled. */
async function keyOfTarget(env) {
  return createHash("sha256")
    .update(`${root}\0${await keyOfCrates(env)}`)
    .digest("hex");
}

/** Returns a hash of each file of the workspace, by its path below `rust/`. */
function hashesOfSources() {
  const folders = readdirSync(RUST).filter((name) => name !== "target" && statSync(join(RUST, name)).isDirectory());
  const inside = folders.flatMap((name) =>
    readdirSync(join(RUST, name), { recursive: true }).map((path) => join(name, path)),
  );
  const files = ["Cargo.toml", "Cargo.lock", ...inside].filter((path) => statSync(join(RUST, path)).isFile());
  const hashOf = (path) =>
    createHash("sha256")
      .update(readFileSync(join(RUST, path)))
      .digest("hex");
  return Object.fromEntries(files.sort().map((path) => [path, hashOf(path)]));
}

/** Makes unchanged sources older than their compiled files: cargo compares the files' times. */
function ageSources() {
  const now = hashesOfSources();
  for (const [path, hash] of Object.entries(JSON.parse(readFileSync(SOURCES, "utf8"))))
    if (now[path] === hash) utimesSync(join(RUST, path), LONG_AGO, LONG_AGO);
}

/** Returns the names of the workspace's packages. */
async function ownPackages(env) {
  const metadata = ["metadata", "--format-version", "1", "--no-deps", "--offline"];
  const text = await output(env.CARGO ?? "cargo", metadata, { env, cwd: RUST });
  return text && new Set(JSON.parse(text).packages.map(({ name }) => name));
}

/** Copies the cached files into a target in which nothing was compiled yet. */
export async function takeCompiled(env) {
  if (process.env.CARGO_TARGET_DIR || existsSync(TARGET)) return;
  const asItWas = { preserveTimestamps: true };
  if (takeBuilt(await keyOfTarget(env), PART, TARGET, { kind: "targets", ...asItWas })) ageSources();
  else takeBuilt(await keyOfCrates(env), PART, TARGET, { kind: "crates", ...asItWas });
}

/** Stores what was compiled: third-party crates, and everything if STRUT_KEEP_TARGET is set. */
export async function keepCompiled(env) {
  if (process.env.CARGO_TARGET_DIR || !existsSync(join(TARGET, ".fingerprint"))) return;
  await keepCrates(env);
  if (process.env.STRUT_KEEP_TARGET) await keepTarget(env);
}

/** Stores the target for a clone in the same folder, unless it is stored for the same sources. */
async function keepTarget(env) {
  const sources = JSON.stringify(hashesOfSources());
  if (existsSync(SOURCES) && readFileSync(SOURCES, "utf8") === sources) return;
  writeFileSync(SOURCES, sources);
  keepBuilt(await keyOfTarget(env), PART, TARGET, { kind: "targets" });
}

/** Stores the compiled third-party crates, unless they are stored for the same lock file. */
async function keepCrates(env) {
  const key = await keyOfCrates(env);
  if (isKept(key, PART, "crates")) return;
  const own = await ownPackages(env);
  if (!own) return;
  const hashes = new Set();
  for (const entry of readdirSync(join(TARGET, ".fingerprint"))) {
    const hash = HASH.exec(entry)?.[1];
    if (hash && !own.has(entry.slice(0, -hash.length - 1))) hashes.add(hash);
  }
  const filter = (path) => {
    const [folder, entry, inside] = relative(TARGET, path).split(sep);
    if (entry === undefined) return folder === "" || FOLDERS.includes(folder);
    return inside !== undefined || hashes.has(HASH.exec(entry)?.[1]);
  };
  keepBuilt(key, PART, TARGET, { kind: "crates", filter });
}
