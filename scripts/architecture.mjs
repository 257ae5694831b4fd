// Fails when an arrow of DESIGN §2 turns, when the core learns of the outside world, or when docs/ARCHITECTURE.md
// names a path that does not exist.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { root, Sentence } from "./steps.mjs";

/** Which crates each crate may depend on. */
const CRATES = {
  "strut-core": [],
  "strut-formats": ["strut-core"],
  "strut-demo": ["strut-core"],
  "strut-wasm": ["strut-core", "strut-formats", "strut-demo"],
  "strut-wasm-build": ["strut-core", "strut-formats"],
  "strut-wasm-walk": ["strut-core", "strut-formats"],
  "strut-wasm-key-style": ["strut-core", "strut-formats"],
  "strut-cli": ["strut-core", "strut-formats", "strut-demo"],
  xtask: ["strut-demo", "strut-formats"],
};

/** Which folders of web/ each folder may import from; a file after a slash narrows it. */
const FOLDERS = {
  engine: [],
  worker: ["engine"],
  viewer: [],
  element: ["viewer", "worker"],
  playground: ["element", "viewer", "worker"],
};

// Tests may look outward: only what is shipped is bound by the arrows.

/** What the core must not know. */
const FORBIDDEN_IN_CORE = /\bstd::(fs|net|thread|time|process|env|io)\b|\b(web_sys|js_sys|wasm_bindgen|rayon|wgpu)\b/;

function* filesUnder(folder, endings) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory() && !["pkg", "target", "node_modules"].includes(entry.name))
      yield* filesUnder(path, endings);
    else if (entry.isFile() && endings.some((ending) => entry.name.endsWith(ending))) yield path;
  }
}

const shown = (path) => relative(root, path);

function crateFaults() {
  return Object.entries(CRATES).flatMap(([crate, allowed]) => {
    const manifest = readFileSync(join(root, "rust", crate, "Cargo.toml"), "utf8");
    const shipped = manifest.split(/^\[dev-dependencies\]/m)[0];
    const used = [...shipped.matchAll(/^(strut-[a-z]+)\b/gm)].map((match) => match[1]);
    return used.filter((name) => !allowed.includes(name)).map((name) => `rust/${crate} must not depend on ${name}`);
  });
}

function coreFaults() {
  const shipped = [...filesUnder(join(root, "rust", "strut-core", "src"), [".rs"])].filter(
    (path) => !path.endsWith("tests.rs"),
  );
  return shipped.flatMap((path) => {
    const match = FORBIDDEN_IN_CORE.exec(readFileSync(path, "utf8"));
    return match ? [`${shown(path)} uses ${match[0]}; the core knows nothing of the outside world`] : [];
  });
}

function importFaults() {
  const web = join(root, "web");
  const shipped = [...filesUnder(web, [".ts"])].filter((path) => !path.endsWith(".test.ts"));
  return shipped.flatMap((path) => {
    const folder = relative(web, path).split(/[\\/]/)[0];
    const allowed = FOLDERS[folder];
    if (!allowed) return [`web/${folder} is not in the folder tree of scripts/architecture.mjs`];
    const imports = [...readFileSync(path, "utf8").matchAll(/(?:from|import|URL)\s*\(?\s*["'](\.[^"']+)["']/g)];
    return imports.flatMap(([, specifier]) => {
      const target = relative(web, resolve(dirname(path), specifier)).split(/[\\/]/)[0];
      if (target === folder || allowed.includes(target)) return [];
      return [
        `${shown(path)} must not import ${specifier}: web/${folder} may use ${allowed.join(", ") || "nothing else"}`,
      ];
    });
  });
}

function documentFaults() {
  const document = join(root, "docs", "ARCHITECTURE.md");
  const paths = [
    ...readFileSync(document, "utf8").matchAll(/`((?:rust|web|tests|scripts|docs|bench|public)\/[^`\s*{]*)`/g),
  ];
  return paths
    .filter(([, path]) => !existsSync(join(root, path)))
    .map(([, path]) => `docs/ARCHITECTURE.md names ${path}, which does not exist`);
}

/** Throws a sentence that lists every fault. */
export function checkArchitecture() {
  const faults = [...crateFaults(), ...coreFaults(), ...importFaults(), ...documentFaults()];
  if (faults.length) throw new Sentence(`the architecture is broken:\n  ${faults.join("\n  ")}`);
  return "every arrow points inward";
}
