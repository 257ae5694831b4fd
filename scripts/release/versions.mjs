// The version: the files that contain it, their consistency, and the raising of it.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { root as projectRoot, Sentence } from "../steps.mjs";

const SEMVER = String.raw`\d+\.\d+\.\d+(?:-[0-9A-Za-z.-]+)?`;

/**
 * Returns the files that contain the version, below the folder `root` of the functions here, by default the project's.
 */
export const versionedFiles = () => [...new Set([...PLACES.map(({ file }) => file), "CHANGELOG.md"])];

/** Files with the version, and its pattern: the first group is the text before it, the second the version. */
const PLACES = [
  { file: "package.json", pattern: '(^  "version": ")(VERSION)' },
  // The first two are the project's own.
  { file: "package-lock.json", pattern: String.raw`("name": "strut-motion",\s+"version": ")(VERSION)`, times: 2 },
  { file: "rust/Cargo.toml", pattern: '(^version = ")(VERSION)' },
  { file: "rust/Cargo.toml", pattern: '(^strut-.* version = ")(VERSION)', times: 6 },
  { file: "rust/Cargo.lock", pattern: String.raw`(^name = "(?:strut-.*|xtask)"\nversion = ")(VERSION)`, times: 11 },
  { file: "blender/strut_motion/blender_manifest.toml", pattern: '(^version = ")(VERSION)' },
  { file: "CITATION.cff", pattern: "(^version: )(VERSION)" },
  { file: "examples/jupyter/package.json", pattern: String.raw`("strut-motion": "\^)(VERSION)` },
  { file: "examples/plain/package.json", pattern: String.raw`("strut-motion": "\^)(VERSION)` },
  { file: "examples/react/package.json", pattern: String.raw`("strut-motion": "\^)(VERSION)` },
  { file: "examples/three-scene/package.json", pattern: String.raw`("strut-motion": "\^)(VERSION)` },
];

const expression = ({ pattern }) => new RegExp(pattern.replace("VERSION", SEMVER), "gm");
const read = (root, file) => readFileSync(join(root, file), "utf8");

/** Returns the version of package.json, which the others must have. */
export const currentVersion = (root = projectRoot) => JSON.parse(read(root, "package.json")).version;

/** Returns a message for each inconsistent version. */
export function versionFaults(root = projectRoot) {
  const version = currentVersion(root);
  return PLACES.flatMap((place) => {
    const found = [...read(root, place.file).matchAll(expression(place))].map((match) => match[2]);
    const expected = place.times ?? 1;
    if (found.length !== expected)
      return [`${place.file} states the version ${found.length} times as ${place.pattern}; ${expected} were expected.`];
    const others = found.filter((other) => other !== version);
    return others.map((other) => `${place.file} states version ${other}; package.json states ${version}.`);
  });
}

const HEADING = new RegExp(String.raw`^## (?:(Unreleased)|(${SEMVER}) \((\d{4}-\d{2}-\d{2})\))$`, "m");

/**
 * Returns a message for each fault of a release with this tag: `v1.2.3` needs the version and a dated section of
 * changes.
 */
export function tagFaults(tag, root = projectRoot) {
  const version = currentVersion(root);
  const faults = [];
  if (tag !== `v${version}`) faults.push(`The tag is ${tag}; package.json states version ${version}.`);
  const [, , released] = HEADING.exec(read(root, "CHANGELOG.md")) ?? [];
  if (released !== version)
    faults.push(`CHANGELOG.md must begin with "## ${version} (date)"; npm run release -- --raise writes it.`);
  return faults;
}

/** Returns the changes of the newest section of the changelog, as Markdown. */
export function newestChanges(root = projectRoot) {
  const [, ...sections] = read(root, "CHANGELOG.md").split(/^## .*$/m);
  return sections[0]?.trim() ?? "";
}

/** Raises the version everywhere and gives the changelog's unreleased section its version and date (`2026-11-27`). */
export function raiseVersion(version, date, root = projectRoot) {
  if (!new RegExp(`^${SEMVER}$`).test(version))
    throw new Sentence(`"${version}" is not a version such as 1.2.3 or 1.2.3-rc.1.`);
  const changes = read(root, "CHANGELOG.md");
  if (!/^## Unreleased$/m.test(changes)) throw new Sentence('CHANGELOG.md has no section "## Unreleased" to release.');
  for (const place of PLACES)
    writeFileSync(join(root, place.file), read(root, place.file).replace(expression(place), `$1${version}`));
  writeFileSync(join(root, "CHANGELOG.md"), changes.replace(/^## Unreleased$/m, `## ${version} (${date})`));
}
