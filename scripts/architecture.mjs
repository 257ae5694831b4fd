// Fails if a dependency between parts (docs/ARCHITECTURE.md) has the wrong direction, modules of a crate depend on each
// other in a cycle, the core uses the outside world, or documents or comments name something that does not exist.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, relative } from "node:path";
import { referenceFaults } from "./methods.mjs";
import { moduleCircles } from "./rust_modules.mjs";
import { root, Sentence } from "./steps.mjs";
import { importCircles, webModules } from "./web_modules.mjs";

/** Which crates each crate may depend on. */
const CRATES = {
  "strut-core": [],
  "strut-evaluation": ["strut-core"],
  "strut-formats": ["strut-core"],
  "strut-demo": ["strut-core"],
  "strut-gpu": ["strut-core"],
  "strut-wasm": ["strut-core", "strut-evaluation", "strut-formats", "strut-demo", "strut-gpu"],
  "strut-tasks": ["strut-core", "strut-evaluation", "strut-formats", "strut-demo"],
  "strut-cli": ["strut-tasks", "strut-core", "strut-evaluation", "strut-formats", "strut-demo", "strut-gpu"],
  "strut-python": ["strut-tasks", "strut-core", "strut-formats", "strut-demo"],
  fuzz: ["strut-core", "strut-formats", "strut-demo"],
  xtask: [],
};

/** Which folders of web/ each folder may import from. A file belongs to the longest of these paths that contains it. */
const ROOMS = {
  humanoid: [],
  engine: ["humanoid"],
  client: ["engine", "humanoid"],
  mannequin: ["humanoid"],
  viewer: ["mannequin", "humanoid"],
  formats: ["mannequin", "humanoid"],
  character: ["client", "engine", "humanoid", "formats", "mannequin"],
  // Sources of live poses.
  streams: ["formats", "client", "engine", "humanoid"],
  player: ["client", "humanoid"],
  // Controls that the page and the element share.
  ui: [],
  // Contents of links.
  link: ["ui", "client", "humanoid"],
  // The scripts of the documentation.
  manual: ["ui"],
  // Public types of the package, of which the element is a part.
  "package/types.ts": ["formats", "streams", "client", "engine", "humanoid"],
  element: ["character", "package/types.ts", "link", "ui", "player", "viewer", "client", "humanoid"],
  // One live figure, on any page, independent of lessons. The tables of documents are read when the page is built.
  figures: ["element", "link", "ui", "player", "viewer", "client", "humanoid", "docs"],
  lessons: ["figures", "link", "ui", "client", "humanoid"],
  // The pages for iframes.
  embed: ["figures", "element"],
  package: ["element", "character", "package/types.ts", "formats", "streams", "client", "engine", "humanoid"],
  "app/strings": ["ui"],
  "app/ui": ["app/strings", "formats", "link", "ui", "player", "viewer", "client", "humanoid"],
  "app/state": ["app/ui", "app/strings", "link", "ui", "player", "viewer", "client", "humanoid"],
  "app/outputs": [
    "character",
    "app/state",
    "app/ui",
    "app/strings",
    "formats",
    "link",
    "ui",
    "player",
    "viewer",
    "client",
    "humanoid",
  ],
  // Interface between a view and the page.
  "app/view.ts": ["app/state", "app/ui", "link", "ui", "player", "viewer", "client", "humanoid"],
  "app/animated_view.ts": ["app/view.ts", "app/state"],
  "app/views": ["app/animated_view.ts", "app/view.ts", "app/outputs", "app/state", "app/ui", "app/strings"].concat([
    "lessons",
    "figures",
    "formats",
    "streams",
    "link",
    "ui",
    "player",
    "viewer",
    "client",
    "humanoid",
  ]),
  app: ["character", "app/views", "app/view.ts", "app/outputs", "app/state", "app/ui", "app/strings"].concat([
    "link",
    "ui",
    "player",
    "viewer",
    "client",
    "humanoid",
  ]),
};

/** Folders of `app/views/` that several views share; other views are independent of each other. */
const SHARED_VIEWS = ["synthesis"];

// Tests may import anything: the rules apply only to what is shipped.

/** APIs that the core must not use. */
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
    const used = [...shipped.matchAll(/^(strut-[a-z-]+)\b/gm)].map((match) => match[1]);
    return used.filter((name) => !allowed.includes(name)).map((name) => `rust/${crate} must not depend on ${name}`);
  });
}

/** Returns the cycles among the modules of each crate. */
function moduleFaults() {
  return Object.keys(CRATES).flatMap((crate) => {
    const source = join(root, "rust", crate, "src");
    const roots = ["lib.rs", "main.rs"].map((file) => join(source, file)).filter(existsSync);
    return roots.flatMap((file) => moduleCircles(file).map((circle) => `rust/${crate}: ${circle}`));
  });
}

/** Returns comments that refer to a missing section of docs/methods/. */
function methodFaults() {
  const folder = join(root, "docs", "methods");
  return [...filesUnder(join(root, "rust"), [".rs"])].flatMap((path) =>
    referenceFaults(readFileSync(path, "utf8"), folder).map((fault) => `${shown(path)}: ${fault}`),
  );
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

/** Returns the folder of a file below web/. All tables of strings count as one folder. */
function roomOf(path) {
  if (path.startsWith("app/") && path.endsWith(".en.ts")) return "app/strings";
  if (path.startsWith("../docs/")) return "docs";
  const rooms = Object.keys(ROOMS).filter((room) => path === room || path.startsWith(`${room}/`));
  return rooms.sort((a, b) => b.length - a.length)[0];
}

/** Returns the view that a file belongs to, if any. */
const viewOf = (path) => /^app\/views\/([^/]+)\//.exec(path)?.[1];

function importFaults() {
  const modules = webModules(join(root, "web"));
  const faults = [...modules].flatMap(([path, imports]) => {
    const room = roomOf(path);
    if (!room) return [`web/${path} is in no room of scripts/architecture.mjs`];
    return [...imports].flatMap(([target, specifier]) => {
      const other = roomOf(target);
      if (other !== room && !ROOMS[room].includes(other))
        return [
          `web/${path} must not import ${specifier}: web/${room} may use ${ROOMS[room].join(", ") || "nothing else"}`,
        ];
      const [view, otherView] = [viewOf(path), viewOf(target)];
      const foreign = view && otherView && view !== otherView && !SHARED_VIEWS.includes(otherView);
      return foreign && room !== "app/strings" && other !== "app/strings"
        ? [`web/${path} must not import ${specifier}: views know nothing of each other`]
        : [];
    });
  });
  return [...faults, ...importCircles(modules)];
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

/** Throws a message that lists every fault. */
export function checkArchitecture() {
  const faults = [
    ...crateFaults(),
    ...moduleFaults(),
    ...coreFaults(),
    ...methodFaults(),
    ...importFaults(),
    ...documentFaults(),
  ];
  if (faults.length) throw new Sentence(`the architecture is broken:\n  ${faults.join("\n  ")}`);
  return "every arrow points inward";
}
