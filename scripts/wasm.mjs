// The WASM packages: cargo compiles the crate with the features of the package, xtask binds it to JavaScript, wasm-opt
// optimises it for size and speed.
//
// There are two modes. `full` is what visitors download: each package from a separate build with fat LTO, then
// wasm-opt. `quick` is for developers and tests: one module with the features of all packages and no wasm-opt. It gives
// bit-identical results (tests/parity) in a fifth of the time. A package that is up to date in full mode is used in
// quick mode, too. Packages that another clone built from the same sources on this machine are taken from the cache.
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { keepBuilt, sourcesHash, takeBuilt } from "./build_cache.mjs";
import { packFirstSteps } from "./first_steps.mjs";
import { findProgram, output, root, run, step } from "./steps.mjs";

/** rustc's name of WebAssembly without an operating system. */
export const TARGET = "wasm32-unknown-unknown";
const RUST = join(root, "rust");

/**
 * LLVM's default inlining makes the module too large to download. At this threshold, and with wasm-opt's -O3 instead of
 * -Os, a frame takes an eighth less time than at a quarter of the threshold, and the module is a twentieth larger.
 */
const INLINE_LESS = "-Cllvm-args=-inline-threshold=100";

/** Less inlining: a frame of driving still takes microseconds, and the module is a twenty-fifth smaller. */
const DRIVE_FLAGS = ["-Cllvm-args=-inline-threshold=50"];

/** Lessons and dragged styles may take a fifth longer, and the module is a tenth smaller. */
const SMALL = {
  flags: ["-Cllvm-args=-inline-threshold=25"],
  config: ["--config", "profile.web.package.strut-motion-core.opt-level=2"],
};

/** Fast code: building a database takes seconds, so that a larger download is worth it. */
const FAST_BUILDING = ["--config", "profile.web.package.strut-motion-formats.opt-level=3"];

/** Small code: a frame of a character takes only microseconds. */
const SMALL_CORE = ["--config", 'profile.web.package.strut-motion-core.opt-level="s"'];

/** Small code: a frame of a stream takes only microseconds. */
const SMALL_STREAMS = { flags: ["-Cllvm-args=-inline-threshold=25"], config: SMALL_CORE };

/** Small code: the GPU does all work that takes time. */
const SMALL_GRAPHICS = ["--config", 'profile.web.package."*".opt-level="z"', "--config", 'profile.web.opt-level="z"'];

/** The reference implementations in `strut-wasm` are optimised like the core. */
const FAST_YARDSTICKS = ["--config", "profile.web.package.strut-wasm.opt-level=3"];

/** The crate of all packages. */
export const CRATE = "strut-wasm";

/**
 * Each package: its folder, the prefix of its files' names, the features of the crate that it is built with; and for
 * full mode additional compiler flags and settings of cargo.
 */
const PACKAGES = {
  // The page's first seconds: the engine without what these do not need, as small as possible.
  start: { folder: "web/engine/start/pkg", name: "strut_start", features: ["engine"], ...SMALL },
  // The engine, which replaces it.
  engine: {
    folder: "web/engine/pkg",
    name: "strut_wasm",
    features: ["files", "atlas", "neutral-clips", "recording"],
    flags: [INLINE_LESS],
  },
  // The engine for other pages, without what only the playground shows.
  embed: { folder: "web/engine/embed/pkg", name: "strut_wasm", features: ["files"], flags: [INLINE_LESS] },
  // Database building from users' own clips.
  build: { folder: "web/engine/build/pkg", name: "strut_wasm_build", features: ["build"], config: FAST_BUILDING },
  // The Walk view.
  walk: { folder: "web/engine/walk/pkg", name: "strut_wasm_walk", features: ["walk"] },
  // Crowds: the same with an additional handle, for a separate worker.
  crowd: { folder: "web/engine/crowd/pkg", name: "strut_crowd", features: ["crowd"] },
  // Crowds that perform a motion.
  performers: { folder: "web/engine/performers/pkg", name: "strut_performers", features: ["performers"] },
  // Driving.
  drive: { folder: "web/engine/drive/pkg", name: "strut_drive", features: ["drive"], flags: DRIVE_FLAGS },
  // Live streams.
  live: { folder: "web/engine/live/pkg", name: "strut_live", features: ["live"], ...SMALL_STREAMS },
  keyStyle: {
    folder: "web/engine/key_style/pkg",
    name: "strut_wasm_key_style",
    features: ["key-style"],
    ...SMALL,
  },
  // Characters.
  character: {
    folder: "web/engine/character/pkg",
    name: "strut_wasm_character",
    features: ["character"],
    config: SMALL_CORE,
  },
  // The atlas with a GPU.
  gpu: {
    folder: "web/engine/gpu/pkg",
    name: "strut_wasm_gpu",
    features: ["gpu"],
    flags: ["-Cllvm-args=-inline-threshold=5"],
    config: SMALL_GRAPHICS,
  },
  // The Compare view: the engine with the methods that it is compared with.
  compare: {
    folder: "web/engine/compare/pkg",
    name: "strut_compare",
    features: ["motions"],
    flags: [INLINE_LESS],
  },
  // The lessons: the same with inspection.
  learn: {
    folder: "web/engine/learn/pkg",
    name: "strut_learn",
    features: ["learn"],
    ...SMALL,
  },
  // The engine with the report that `tests/parity` compares and the reference implementations of `bench/`.
  bench: {
    folder: "bench/pkg/simd",
    name: "strut_bench",
    features: ["bench", "parity"],
    flags: [INLINE_LESS],
    config: FAST_YARDSTICKS,
  },
  // The paper's search on the GPU, with the engine's for comparison.
  benchGpu: {
    folder: "bench/pkg/gpu",
    name: "strut_bench_gpu",
    features: ["gpu-bench"],
    flags: [INLINE_LESS],
  },
  // The benchmark's engine without SIMD, whose bits must be the same.
  benchScalar: {
    folder: "bench/pkg/scalar",
    name: "strut_bench",
    features: ["bench", "parity"],
    flags: [INLINE_LESS],
    config: FAST_YARDSTICKS,
    simd: false,
  },
};

/** Order of the builds in full mode, on two cores: both lines take about the same time. */
const LINES = [
  ["engine", "embed", "compare", "gpu", "bench", "benchGpu", "benchScalar"],
  ["start", "learn", "keyStyle", "walk", "crowd", "performers", "drive", "live", "build", "character"],
];

/** The page's packages, and those that benchmarks and parity tests need in addition. */
const BENCH = ["bench", "benchGpu", "benchScalar"];
const PAGE = LINES.flat().filter((name) => !BENCH.includes(name));

/** The built-in motions: those that the page loads, and those that the package `strut-motion` starts with. */
const MOTIONS = join(root, "web", "engine", "motions");
const MOTIONS_STAMP = join(MOTIONS, "stamp");

/**
 * Features that every browser with WASM SIMD has (Chrome 91, Firefox 89, Safari 16.4) and that rustc emits. Relaxed
 * SIMD is off: its results differ between machines.
 */
const WASM_OPT_FLAGS = [
  // Once: a second pass saves two thousandths of the bytes, and costs a fifth of the build's processor time.
  "-O3",
  "--enable-simd",
  "--enable-bulk-memory",
  "--enable-bulk-memory-opt",
  "--enable-nontrapping-float-to-int",
  "--enable-sign-ext",
  "--enable-mutable-globals",
  "--enable-reference-types",
  "--enable-multivalue",
];
/** Oldest wasm-opt that accepts these flags. */
const MIN_WASM_OPT = 120;

/**
 * Builds the packages of the page, and those of benchmarks and parity tests. Up-to-date ones are kept.
 * @param env environment in which cargo builds for WebAssembly
 * @param mode `full` or `quick`, for the page's packages
 * @param bench the mode for benchmarks and parity tests; without it their packages are not built
 * @param installed resolves when the npm packages are installed, one of which is wasm-opt
 */
export async function buildPackages(env, { mode, bench, installed }) {
  const stamp = await packagesHash(env);
  const outdated = (names, mode) =>
    names.filter((name) => !isCurrent(PACKAGES[name], mode, stamp) && !takePackage(name, mode, stamp));
  const wanted = (built) => [...(mode === built ? PAGE : []), ...(bench === built ? BENCH : [])];
  const full = outdated(wanted("full"), "full");
  if (full.length > 0)
    await step("Building the engine for WebAssembly, fully optimised", () =>
      buildFull(env, full, { stamp, installed }),
    );
  const quick = outdated(wanted("quick"), "quick");
  if (quick.length > 0) await step("Building the engine for WebAssembly", () => buildQuick(env, quick, stamp));
  if (read(MOTIONS_STAMP) !== stamp)
    await step("Generating the built-in motions", async () => {
      const sizes = await writeMotions();
      writeFileSync(MOTIONS_STAMP, stamp);
      return sizes;
    });
}

/** Builds all packages with SIMD as one module and, if requested, those without SIMD in another. */
async function buildQuick(env, names, stamp) {
  const binding = buildXtask(env);
  // A failure is reported where the result is awaited.
  binding.catch(() => {});
  for (const simd of [true, false]) {
    const group = names.map((name) => PACKAGES[name]).filter((p) => (p.simd ?? true) === simd);
    if (group.length === 0) continue;
    const features = [...new Set(group.flatMap((p) => p.features))];
    await compile(env, { features, profile: "quick", simd });
    const [first, ...others] = group;
    await bind(await binding, first, join(targetDir(env), TARGET, "quick"));
    for (const p of others) copyBound(first, p);
    for (const p of group) finish(p, "quick", stamp);
  }
}

/**
 * Builds one package per compilation. A compilation mostly uses a single core, so two lines of packages are built in
 * parallel, each in its own folder, since cargo locks its folder. Packages with the same flags are in the same line and
 * share their dependencies.
 */
async function buildFull(env, names, { stamp, installed }) {
  const xtask = await buildXtask(env);
  await installed;
  const tool = await findWasmOpt();
  const lines = LINES.map((line) => line.filter((name) => names.includes(name)));
  await Promise.all(lines.map((line, i) => buildLine(env, line, { xtask, tool, stamp, folder: `full-${i}` })));
}

/** Builds packages one after the other. While the next one is compiled the last one is optimised. */
async function buildLine(env, names, { xtask, tool, stamp, folder }) {
  const modules = join(targetDir(env), folder);
  let optimising = Promise.resolve();
  for (const name of names) {
    const p = PACKAGES[name];
    const { features, flags = [], config = [], simd = true } = p;
    const options = [...config, "--target-dir", modules];
    await compile(env, { features, profile: "web", simd, flags, options });
    await bind(xtask, p, join(modules, TARGET, "web"));
    await optimising;
    optimising = optimise(tool, p).then(() => finish(p, "full", stamp));
    optimising.catch(() => {});
  }
  await optimising;
}

const targetDir = (env) => env.CARGO_TARGET_DIR ?? process.env.CARGO_TARGET_DIR ?? join(RUST, "target");

/** Runs cargo for WebAssembly. */
async function compile(env, { features, profile, simd, flags = [], options = [] }) {
  const source = env.STRUT_BUILD_STD === "1" ? ["-Zbuild-std=std,panic_abort"] : [];
  const selected = ["--package", CRATE, "--features", features.join()];
  const all = ["--profile", profile, "--lib", "--target", TARGET, ...selected, ...options, ...source];
  await run(env.CARGO ?? "cargo", ["build", "--quiet", ...all], {
    cwd: RUST,
    env: {
      ...env,
      // The encoded form has precedence over RUSTFLAGS, so that no flag of the user can change results.
      CARGO_ENCODED_RUSTFLAGS: [...flags, `-Ctarget-feature=${simd ? "+" : "-"}simd128`].join("\x1f"),
    },
  });
}

/** Builds the tool that binds modules to JavaScript. Returns its path. */
async function buildXtask(env) {
  await run(env.CARGO ?? "cargo", ["build", "--quiet", "--profile", "tool", "--package", "xtask"], { cwd: RUST, env });
  return join(targetDir(env), "tool", "xtask");
}

/** Writes a package's JavaScript, its types and its module, which cargo wrote to the folder `modules`. */
async function bind(xtask, { folder, name }, modules) {
  const module = join(modules, `${CRATE.replaceAll("-", "_")}.wasm`);
  rmSync(join(root, folder), { recursive: true, force: true });
  await run(xtask, ["bind", module, join(root, folder), name]);
}

/** Copies a bound package to another with the same module: binding takes seconds. */
function copyBound(from, to) {
  rmSync(join(root, to.folder), { recursive: true, force: true });
  mkdirSync(join(root, to.folder), { recursive: true });
  const fileOf = ({ folder, name }, ending) => join(root, folder, `${name}${ending}`);
  for (const ending of [".d.ts", "_bg.wasm", "_bg.wasm.d.ts"]) cpSync(fileOf(from, ending), fileOf(to, ending));
  // The module keeps the name of the imports that its own JavaScript gives it.
  const script = readFileSync(fileOf(from, ".js"), "utf8").replace(`./${from.name}.d.ts`, `./${to.name}.d.ts`);
  writeFileSync(fileOf(to, ".js"), script);
}

/** Runs wasm-opt on a package's module in place. */
async function optimise(tool, { folder, name, simd = true }) {
  const module = join(root, folder, `${name}_bg.wasm`);
  const flags = WASM_OPT_FLAGS.filter((flag) => simd || flag !== "--enable-simd");
  const bound = statSync(module).size;
  await run(tool[0], [...tool.slice(1), ...flags, module, "-o", module]);
  const kb = (bytes) => Math.round(bytes / 1000);
  console.log(`  ${folder}: ${kb(bound)} kB bound, ${kb(statSync(module).size)} kB optimised`);
}

/** Returns an installed, native wasm-opt if it is recent enough; else the one of npm's `binaryen`. */
async function findWasmOpt() {
  const native = findProgram("wasm-opt");
  const version = native && /version (\d+)/.exec((await output(native, ["--version"])) ?? "");
  if (version && Number(version[1]) >= MIN_WASM_OPT) return [native];
  return [process.execPath, join(root, "node_modules", "binaryen", "bin", "wasm-opt")];
}

/** Imports a package's bindings. */
async function glueOf({ folder, name }) {
  const glue = await import(pathToFileURL(join(root, folder, `${name}.js`)).href);
  glue.initSync({ module: readFileSync(join(root, folder, `${name}_bg.wasm`)) });
  return glue;
}

/** Returns the walk model that the page would train on these motions. */
async function walkModelOf(motions) {
  const { WalkTraining } = await glueOf(PACKAGES.build);
  const training = new WalkTraining(motions);
  while (training.step({ progress: () => {} }));
  return training.finish().file();
}

/**
 * Writes the built-in motions. The Compare view's package, which has all of them, generates the motions; the package
 * that builds databases trains the walk model on them.
 */
async function writeMotions() {
  const glue = await glueOf(PACKAGES.compare);
  mkdirSync(MOTIONS, { recursive: true });
  const [first, others] = glue.builtInMotions(true);
  const [walks, besides] = glue.builtInMotions(false);
  const sets = {
    "first.bin": first,
    "built_in.bin": others,
    "walk.bin": walks,
    "besides_walk.bin": besides,
    "first_steps.bin": firstSteps(glue, first),
    "drive.bin": glue.drivingMotions(),
    "built_in.strutwalk": await walkModelOf(Buffer.concat([walks, besides])),
  };
  const sizes = Object.entries(sets).map(([name, motions]) => {
    // Of all memory levels of zlib this one compresses the motions best: its blocks are short, and the columns differ.
    const bytes = gzipSync(motions, { level: 9, memLevel: 6 });
    writeFileSync(join(MOTIONS, name), bytes);
    return `${name} ${Math.round(bytes.length / 1000)} kB`;
  });
  return sizes.join(", ");
}

/** Returns the input of a set of motions, which the page shows until the engine is loaded. */
function firstSteps(glue, bytes) {
  const motions = new glue.PackedMotions(bytes);
  const database = glue.Database.fromPacked(motions);
  const input = glue.Input.fromPacked(database, motions, motions.inputs()[0]);
  return packFirstSteps(input.poses(), database.rateHz());
}

const stampFile = ({ folder }) => join(root, folder, "stamp");
const read = (path) => (existsSync(path) ? readFileSync(path, "utf8") : undefined);

function isCurrent(p, mode, stamp) {
  const [builtMode, builtStamp] = read(stampFile(p))?.split(" ") ?? [];
  return builtStamp === stamp && (builtMode === mode || builtMode === "full");
}

/** Writes the stamp last: an interrupted build has none and is repeated. */
function finish(p, mode, stamp) {
  writeFileSync(stampFile(p), `${mode} ${stamp}`);
  keepBuilt(stamp, keptAs(p, mode), join(root, p.folder));
}

/** Copies a package that another clone built. Returns whether there is one. */
function takePackage(name, mode, stamp) {
  const p = PACKAGES[name];
  return ["full", mode].some((built) => takeBuilt(stamp, keptAs(p, built), join(root, p.folder)));
}

const keptAs = ({ folder }, mode) => join(mode, folder.replaceAll("/", "-"));

/** Returns a hash of what the packages depend on: the Rust sources, the compiler, this file and wasm-opt. */
function packagesHash(env) {
  const { packages } = JSON.parse(readFileSync(join(root, "package-lock.json"), "utf8"));
  return sourcesHash(env, {
    left: ["strut-cli", "strut-tasks", "strut-python", "fuzz"],
    files: [fileURLToPath(import.meta.url)],
    texts: [packages["node_modules/binaryen"].integrity],
  });
}
