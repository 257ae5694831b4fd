// Cache of builds that take minutes, by a hash of their sources: another clone of the same sources on this machine uses
// it. Located in `$XDG_CACHE_HOME/strut` (else `~/.cache/strut`). STRUT_BUILD_CACHE=off disables it.
import { createHash } from "node:crypto";
import {
  cpSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  renameSync,
  rmSync,
  statSync,
  utimesSync,
} from "node:fs";
import { homedir } from "node:os";
import { dirname, join, relative } from "node:path";
import { output, root } from "./steps.mjs";

/**
 * Folders of the cache, and the number of most recently used entries of each that are kept: third-party crates and
 * whole targets are large.
 */
const KEPT = { builds: 12, crates: 2, targets: 2 };

/** Yields the source files of Rust builds below a folder, without folders of some names. */
function* rustSources(folder, left) {
  const entries = readdirSync(folder, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1));
  for (const entry of entries) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) {
      if (!left.includes(entry.name)) yield* rustSources(path, left);
    } else if (/\.(rs|wgsl|toml|lock)$/.test(entry.name) && entry.name !== "tests.rs") yield path;
  }
}

/**
 * Returns a hash of everything that a build depends on: the Rust sources, the compiler and the given inputs.
 * @param env environment in which cargo builds
 * @param left names of folders below `rust/` on which it does not depend
 * @param files other files on which it depends, including the script that builds it
 * @param texts other values on which it depends
 */
export async function sourcesHash(env, { left = [], files = [], texts = [] }) {
  const hash = createHash("sha256");
  for (const path of [...rustSources(join(root, "rust"), ["target", "tests", "benches", ...left]), ...files])
    hash
      .update(`${relative(root, path)}\0`)
      .update(readFileSync(path))
      .update("\0");
  for (const text of [await output(env.RUSTC ?? "rustc", ["--version"], { env }), ...texts]) hash.update(`${text}\0`);
  return hash.digest("hex");
}

const cacheFolder = (kind) =>
  process.env.STRUT_BUILD_CACHE === "off"
    ? undefined
    : join(process.env.XDG_CACHE_HOME ?? join(homedir(), ".cache"), "strut", kind);

/**
 * Copies a part of an entry to a folder, and replaces the folder's contents.
 * @param key hash of what the part was built from
 * @param part name of the part
 * @param kind folder of the cache
 * @param preserveTimestamps whether files keep the times of the original build
 * @returns whether the part exists.
 */
export function takeBuilt(key, part, folder, { kind = "builds", preserveTimestamps = false } = {}) {
  const cache = cacheFolder(kind);
  const entry = cache && join(cache, key);
  if (!entry || !existsSync(join(entry, part))) return false;
  rmSync(folder, { recursive: true, force: true });
  cpSync(join(entry, part), folder, { recursive: true, preserveTimestamps });
  const now = new Date();
  utimesSync(entry, now, now);
  return true;
}

/** Returns whether a part of an entry exists, or the cache is off. */
export function isKept(key, part, kind = "builds") {
  const cache = cacheFolder(kind);
  return !cache || existsSync(join(cache, key, part));
}

/**
 * Stores a folder as a part of an entry, and removes entries that were not used recently. Does nothing if the cache is
 * off.
 * @param kind folder of the cache
 * @param filter whether a path of the folder is stored
 */
export function keepBuilt(key, part, folder, { kind = "builds", filter = () => true } = {}) {
  const cache = cacheFolder(kind);
  if (!cache) return;
  const place = join(cache, key, part);
  try {
    mkdirSync(dirname(place), { recursive: true });
    // Stored atomically: another clone may store the same at this moment.
    const copy = mkdtempSync(join(cache, "copy-"));
    cpSync(folder, copy, { recursive: true, preserveTimestamps: true, filter });
    rmSync(place, { recursive: true, force: true });
    renameSync(copy, place);
    forgetOld(cache, KEPT[kind]);
  } catch (error) {
    console.warn(`  not cached for other clones: ${error.message}`);
  }
}

function forgetOld(cache, kept) {
  const used = (entry) => statSync(join(cache, entry), { throwIfNoEntry: false })?.mtimeMs ?? 0;
  const byUse = readdirSync(cache).sort((a, b) => used(b) - used(a));
  for (const entry of byUse.slice(kept)) rmSync(join(cache, entry), { recursive: true, force: true });
}
