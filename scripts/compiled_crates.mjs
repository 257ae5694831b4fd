// What cargo compiled of crates that are not ours: a new clone takes it from another one on this machine, which is about
// half of what its lints and tests would compile. cargo itself judges whether a crate is up to date.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, relative, sep } from "node:path";
import { isKept, keepBuilt, takeBuilt } from "./build_cache.mjs";
import { output, root } from "./steps.mjs";

const RUST = join(root, "rust");
/** Where lints and tests are compiled. */
const TARGET = join(RUST, "target", "debug");
/** Folders of a target in which a crate has entries, `name-hash` with or without something before and after. */
const FOLDERS = [".fingerprint", "build", "deps"];
const KIND = "crates";
const PART = "debug";

/** The end of an entry's name: a hash, and in `deps` an extension. */
const HASH = /-([0-9a-f]{16})(\.\w+)?$/;

/** A hash of what decides which crates are compiled, and how. */
async function keyOf(env) {
  const folders = readdirSync(RUST, { withFileTypes: true }).filter((entry) => entry.isDirectory());
  const manifests = folders.map(({ name }) => join(RUST, name, "Cargo.toml")).filter((path) => existsSync(path));
  const settings = [join(RUST, ".cargo", "config.toml"), join(RUST, "Cargo.toml"), join(RUST, "Cargo.lock")];
  const hash = createHash("sha256");
  for (const path of [...settings, ...manifests.sort()]) hash.update(readFileSync(path)).update("\0");
  return hash.update((await output(env.RUSTC ?? "rustc", ["-vV"], { env })) ?? "").digest("hex");
}

/** Names of the workspace's packages. */
async function ownPackages(env) {
  const metadata = ["metadata", "--format-version", "1", "--no-deps", "--offline"];
  const text = await output(env.CARGO ?? "cargo", metadata, { env, cwd: RUST });
  return text && new Set(JSON.parse(text).packages.map(({ name }) => name));
}

/** Gives a target in which nothing was compiled yet what is kept of crates that are not ours. */
export async function takeCrates(env) {
  if (process.env.CARGO_TARGET_DIR || existsSync(TARGET)) return;
  takeBuilt(await keyOf(env), PART, TARGET, { kind: KIND, preserveTimestamps: true });
}

/** Keeps what was compiled of crates that are not ours, unless that of the same lock file is kept already. */
export async function keepCrates(env) {
  if (process.env.CARGO_TARGET_DIR || !existsSync(join(TARGET, ".fingerprint"))) return;
  const key = await keyOf(env);
  if (isKept(key, PART, KIND)) return;
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
  keepBuilt(key, PART, TARGET, { kind: KIND, filter });
}
