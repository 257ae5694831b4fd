// dist/notices.txt and dist/sbom.cdx.json: third-party parts of the site and the package, with their licences. Vite
// lists the npm packages in the page's modules (build.license), cargo the crates in those of WebAssembly.
import { existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { output, root, Sentence } from "./steps.mjs";
import { CRATE, TARGET } from "./wasm.mjs";

const DIST = join(root, "dist");
/** File in which Vite lists its packages; it is not part of the site. */
export const NPM_LICENCES = ".vite/licenses.json";

/** Licences that are allowed for shipped parts. */
const ALLOWED = new Set([
  "0BSD",
  "Apache-2.0",
  "BSD-2-Clause",
  "BSD-3-Clause",
  "BSL-1.0",
  "CC0-1.0",
  "ISC",
  "MIT",
  // Applies to unchanged files; the notices give the address of their source.
  "MPL-2.0",
  "OFL-1.1",
  "Unicode-3.0",
  "Unlicense",
  "Zlib",
]);

/**
 * Packages that are not in the page's modules: fonts from style sheets, and those that esbuild puts into the service
 * worker and the documentation's scripts.
 */
const BESIDE_MODULES = [
  "@fontsource-variable/inter",
  "@fontsource-variable/source-serif-4",
  "katex",
  "minisearch",
  "workbox-core",
  "workbox-precaching",
  "workbox-routing",
  "workbox-strategies",
];

/**
 * Third-party code within an npm package that ships without its licence. The Draco decoder of three.js is of this
 * version.
 */
const WITHIN_PACKAGES = [
  {
    name: "draco3dgltf",
    version: "1.5.6",
    licence: "Apache-2.0",
    source: "https://github.com/google/draco",
    text: readFileSync(join(root, "LICENSE-APACHE"), "utf8"),
    purl: "pkg:npm/draco3dgltf@1.5.6",
  },
];

/**
 * Returns whether an SPDX expression is allowed: at least one of its alternatives, in each of the bracketed groups
 * joined by AND.
 */
export function isAllowed(expression) {
  const one = (licences) => licences.split(" OR ").some((licence) => ALLOWED.has(licence));
  if (expression.includes("(")) return expression.split(" AND ").every((group) => one(group.replace(/^\(|\)$/g, "")));
  return expression.split(" OR ").some((licences) => licences.split(" AND ").every((licence) => ALLOWED.has(licence)));
}

/** Writes both files for the built site and packages. Returns how many parts there are. */
export async function writeNotices(env) {
  const parts = [...npmPackages(), ...WITHIN_PACKAGES, ...(await crates(env))];
  const refused = parts.filter(({ licence }) => !isAllowed(licence));
  if (refused.length > 0) {
    const list = refused.map(({ name, licence }) => `${name} (${licence || "no licence"})`).join(", ");
    throw new Sentence(`The licences of these packages do not allow shipping them: ${list}.`);
  }
  const version = JSON.parse(readFileSync(join(root, "package.json"), "utf8")).version;
  const notices = noticesOf(parts);
  for (const folder of [DIST, join(DIST, "package")]) {
    writeFileSync(join(folder, "notices.txt"), notices);
    writeFileSync(join(folder, "sbom.cdx.json"), `${JSON.stringify(sbomOf(version, parts), null, 1)}\n`);
  }
  return `${parts.length} parts of others`;
}

/** Returns the npm packages in the site. */
function npmPackages() {
  const list = join(DIST, NPM_LICENCES);
  const inModules = JSON.parse(readFileSync(list, "utf8")).map(({ name }) => name);
  rmSync(list);
  return [...new Set([...inModules, ...BESIDE_MODULES])].sort().map((name) => {
    const folder = join(root, "node_modules", name);
    const { version, license, homepage } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const purl = `pkg:npm/${name.replace("@", "%40")}@${version}`;
    return { name, version, licence: license ?? "", source: homepage ?? "", text: licenceText(folder), purl };
  });
}

/** Returns the crates in the WASM packages. */
async function crates(env) {
  const cargo = (args) => output(env.CARGO ?? "cargo", args, { env, cwd: join(root, "rust") });
  // Macro crates are not part of the built code.
  const edges = ["--edges", "normal,no-proc-macro", "--target", TARGET, "--all-features"];
  const tree = await cargo(["tree", "--package", CRATE, ...edges, "--prefix", "none", "--format", "{p}"]);
  const metadata = await cargo(["metadata", "--format-version", "1", "--all-features", "--filter-platform", TARGET]);
  if (tree === undefined || metadata === undefined) throw new Sentence("cargo did not report the dependencies.");
  const used = new Set(tree.split("\n").map((line) => line.split(" ").slice(0, 2).join(" ")));
  return JSON.parse(metadata)
    .packages.filter(({ source, name, version }) => source && used.has(`${name} v${version}`))
    .map(({ name, version, license, repository, manifest_path }) => ({
      name,
      version,
      licence: (license ?? "").replaceAll("/", " OR "),
      source: repository ?? "",
      text: licenceText(dirname(manifest_path)),
      purl: `pkg:cargo/${name}@${version}`,
    }))
    .sort((a, b) => (a.purl < b.purl ? -1 : 1));
}

/** Returns the texts of the licence files in a folder. */
function licenceText(folder) {
  if (!existsSync(folder)) return "";
  const names = readdirSync(folder, { withFileTypes: true })
    .filter((entry) => entry.isFile() && /^(un)?licen[cs]e|^copying|^notice/i.test(entry.name))
    .map(({ name }) => name)
    .sort();
  return names.map((name) => readFileSync(join(folder, name), "utf8").trim()).join("\n\n");
}

/** Returns the notices. Equal texts are printed once, below all parts with this licence. */
function noticesOf(parts) {
  const byText = new Map();
  for (const part of parts) {
    const text = part.text.replaceAll("\r", "").trim();
    byText.set(text, [...(byText.get(text) ?? []), part]);
  }
  const heading = "Strut contains the work of others. This is what it is, and under which licences it may be used.";
  const sections = Array.from(byText, ([text, users]) =>
    [...users.map(({ name, version, licence, source }) => `${name} ${version} (${licence}) ${source}`.trim()), "", text]
      .join("\n")
      .trim(),
  );
  return `${[heading, ...sections].join(`\n\n${"-".repeat(80)}\n\n`)}\n`;
}

/**
 * Returns a software bill of materials in CycloneDX 1.6. It has no time and no serial number, so that builds can be
 * compared.
 */
function sbomOf(version, parts) {
  const component = ({ name, version, licence, purl }) => ({
    type: "library",
    "bom-ref": purl,
    name,
    version,
    licenses: [{ expression: licence }],
    purl,
  });
  return {
    $schema: "http://cyclonedx.org/schema/bom-1.6.schema.json",
    bomFormat: "CycloneDX",
    specVersion: "1.6",
    version: 1,
    metadata: { component: { type: "application", "bom-ref": "strut-motion", name: "strut-motion", version } },
    components: parts.map(component),
  };
}
