// What cargo compiled for lints and tests: a new clone takes it from another one on this machine. Of other people's crates
// any clone does, which is about half of what it would compile; of our own, where CI keeps them, a clone in the same folder,
// as tests hold the paths of their programs and files. cargo itself judges what is up to date.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync, statSync, utimesSync, writeFileSync } from "node:fs";
import { join, relative, sep } from "node:path";
import { isKept, keepBuilt, takeBuilt } from "./build_cache.mjs";
import { output, root } from "./steps.mjs";

const RUST = join(root, "rust");
/** Where lints and tests are compiled. */
const TARGET = join(RUST, "target", "debug");
/** In the target: a hash of each source from which it was compiled, by the path below `rust/`. */
const SOURCES = join(TARGET, "sources.json");
/** Folders of a target in which a crate has entries, `name-hash` with or without something before and after. */
const FOLDERS = [".fingerprint", "build", "deps"];
const PART = "debug";
/** A time before anything was compiled. */
const LONG_AGO = new Date("2000-01-01");

/** The end of an entry's name: a hash, and in `deps` an extension. */
const HASH = /-([0-9a-f]{16})(\.\w+)?$/;

const compiler = async (env) => (await output(env.RUSTC ?? "rustc", ["-vV"], { env })) ?? "";

/** A hash of what decides which crates are compiled, and how. */
async function keyOfCrates(env) {
  const folders = readdirSync(RUST, { withFileTypes: true }).filter((entry) => entry.isDirectory());
  const manifests = folders.map(({ name }) => join(RUST, name, "Cargo.toml")).filter((path) => existsSync(path));
  const settings = [join(RUST, ".cargo", "config.toml"), join(RUST, "Cargo.toml"), join(RUST, "Cargo.lock")];
  const hash = createHash("sha256");
  for (const path of [...settings, ...manifests.sort()]) hash.update(readFileSync(path)).update("\0");
  return hash.update(await compiler(env)).digest("hex");
}

/** A hash of whose target this is: the folder of the clone, and what decides which crates are compiled. */
async function keyOfTarget(env) {
  return createHash("sha256")
    .update(`${root}\0${await keyOfCrates(env)}`)
    .digest("hex");
}

/** A hash of each file of the workspace, by its path below `rust/`. */
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

/** Makes the sources that are as they were older than what was compiled of them: cargo goes by the files' times. */
function ageSources() {
  const now = hashesOfSources();
  for (const [path, hash] of Object.entries(JSON.parse(readFileSync(SOURCES, "utf8"))))
    if (now[path] === hash) utimesSync(join(RUST, path), LONG_AGO, LONG_AGO);
}

/** Names of the workspace's packages. */
async function ownPackages(env) {
  const metadata = ["metadata", "--format-version", "1", "--no-deps", "--offline"];
  const text = await output(env.CARGO ?? "cargo", metadata, { env, cwd: RUST });
  return text && new Set(JSON.parse(text).packages.map(({ name }) => name));
}

/** Gives a target in which nothing was compiled yet what is kept for it. */
export async function takeCompiled(env) {
  if (process.env.CARGO_TARGET_DIR || existsSync(TARGET)) return;
  const asItWas = { preserveTimestamps: true };
  if (takeBuilt(await keyOfTarget(env), PART, TARGET, { kind: "targets", ...asItWas })) ageSources();
  else takeBuilt(await keyOfCrates(env), PART, TARGET, { kind: "crates", ...asItWas });
}

/** Keeps what was compiled: other people's crates, and all of it where STRUT_KEEP_TARGET is set. */
export async function keepCompiled(env) {
  if (process.env.CARGO_TARGET_DIR || !existsSync(join(TARGET, ".fingerprint"))) return;
  await keepCrates(env);
  if (process.env.STRUT_KEEP_TARGET) await keepTarget(env);
}

/** Keeps the target for a clone in the same folder, unless the sources are those of what is kept. */
async function keepTarget(env) {
  const sources = JSON.stringify(hashesOfSources());
  if (existsSync(SOURCES) && readFileSync(SOURCES, "utf8") === sources) return;
  writeFileSync(SOURCES, sources);
  keepBuilt(await keyOfTarget(env), PART, TARGET, { kind: "targets" });
}

/** Keeps what was compiled of crates that are not ours, unless that of the same lock file is kept already. */
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
