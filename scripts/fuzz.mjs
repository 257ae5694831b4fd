// npm run fuzz -- [--minutes N] [--keep] [--lines] [TARGET …]: runs the targets of rust/fuzz under libFuzzer for N
// minutes in total (2), one per core at once; then fuzzes the page's own parsers (tests/fuzz). --keep replaces
// rust/fuzz/corpus by a minimised corpus with the same coverage. --lines counts the covered lines of the engine. A
// failing input is added to the corpus, so that `npm test` fails until the fault is fixed.
import { spawn } from "node:child_process";
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { availableParallelism } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { keepBuilt, sourcesHash, takeBuilt } from "./build_cache.mjs";
import { buildCounted } from "./fuzz_lines.mjs";
import { checkNode, setupCxx, setupPackages, setupRust } from "./setup.mjs";
import { main, output, root, run, Sentence, step } from "./steps.mjs";

const RUST = join(root, "rust");
const CORPUS = join(RUST, "fuzz", "corpus");

/** Instrumentation for libFuzzer: edge counters, and operands of comparisons. */
const COVERAGE = [
  "-Cpasses=sancov-module",
  "-Cllvm-args=-sanitizer-coverage-level=4",
  "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
  "-Cllvm-args=-sanitizer-coverage-pc-table",
  "-Cllvm-args=-sanitizer-coverage-trace-compares",
];

const DEFAULT_MINUTES = 2;
/** Time after which an input counts as hanging. */
const TIMEOUT_SECS = 20;
const MAX_MEMORY_MB = 2048;
/** Number of inputs of a target that the repository keeps, besides those that once failed. */
const KEPT = 24;
/** Names of inputs that once failed, and of seeds. */
const LASTING = /^(crash|oom|timeout|leak|slow-unit|seed)-/;
/** Inputs per minute of each test of the page's parsers. */
const PAGE_RUNS = 300;

/** Arguments of cargo. */
const CARGO_ARGS = ["--profile", "fuzz", "--package", "strut-fuzz", "--features", "libfuzzer"];

/**
 * Builds the targets. Returns the paths of the program and of the folder for a run's results, and the parameters of the
 * build.
 */
async function build(env) {
  const host = /^host: (.+)$/m.exec((await output(env.RUSTC ?? "rustc", ["-vV"], { env })) ?? "")?.[1];
  if (!host) throw new Sentence("rustc does not report its host target.");
  const folder = join(env.CARGO_TARGET_DIR ?? process.env.CARGO_TARGET_DIR ?? join(RUST, "target"), "fuzz");
  const program = join(folder, "program", "strut-fuzz");
  const key = await sourcesHash(env, { files: [fileURLToPath(import.meta.url)], texts: [host] });
  const built = { program, found: join(folder, "corpus"), host, folder };
  if (takeBuilt(key, "fuzz", dirname(program))) return built;
  // With an explicit target, the flags do not apply to build scripts.
  await run(env.CARGO ?? "cargo", ["build", "--quiet", ...CARGO_ARGS, "--target", host, "--target-dir", folder], {
    cwd: RUST,
    env: { ...env, CARGO_ENCODED_RUSTFLAGS: COVERAGE.join("\x1f") },
  });
  mkdirSync(dirname(program), { recursive: true });
  copyFileSync(join(folder, host, "fuzz", "strut-fuzz"), program);
  keepBuilt(key, "fuzz", dirname(program));
  return built;
}

/** Returns the targets' names with the longest useful input of each, as listed in the sources. */
function targets() {
  const source = readFileSync(join(RUST, "fuzz", "src", "lib.rs"), "utf8");
  const listed = source.matchAll(/Target \{ name: "(\w+)", max_len: (\d+)/g);
  return new Map(Array.from(listed, ([, name, bytes]) => [name, Number(bytes)]));
}

/** Runs a target. Returns libFuzzer's final output. */
function fuzz({ program, found }, name, maxLen, secs) {
  const [own, kept] = [join(found, name), join(CORPUS, name)];
  for (const folder of [own, kept]) mkdirSync(folder, { recursive: true });
  const limits = [`-max_total_time=${secs}`, `-timeout=${TIMEOUT_SECS}`, `-rss_limit_mb=${MAX_MEMORY_MB}`];
  const options = [...limits, `-max_len=${maxLen}`, "-print_final_stats=1", `-artifact_prefix=${kept}/`];
  return new Promise((resolve, reject) => {
    const env = { ...process.env, STRUT_FUZZ_TARGET: name };
    const child = spawn(program, [...options, own, kept], { env, stdio: ["ignore", "ignore", "pipe"] });
    let text = "";
    child.stderr.on("data", (chunk) => {
      text += chunk;
    });
    child.on("error", reject);
    child.on("close", (code) => {
      const number = (pattern) => Number(text.match(pattern)?.at(-1)?.match(/\d+/)?.[0] ?? 0);
      resolve({
        name,
        failed: code !== 0,
        text,
        runs: number(/number_of_executed_units: +\d+/g),
        edges: number(/cov: \d+/g),
        inputs: readdirSync(own).length,
      });
    });
  });
}

/** Replaces the corpus of a target by short and long inputs that together have the same coverage. */
async function keep({ program, found }, name) {
  const [own, kept, merged] = [join(found, name), join(CORPUS, name), join(found, `${name}.merged`)];
  rmSync(merged, { recursive: true, force: true });
  mkdirSync(merged, { recursive: true });
  if ((await output(program, ["-merge=1", merged, own, kept], { env: { STRUT_FUZZ_TARGET: name } })) === undefined)
    throw new Sentence(`The inputs of ${name} could not be merged.`);
  for (const file of readdirSync(kept)) if (!LASTING.test(file)) rmSync(join(kept, file));
  const bytes = (file) => statSync(join(merged, file)).size;
  const bySize = readdirSync(merged).sort((a, b) => bytes(a) - bytes(b) || (a < b ? -1 : 1));
  for (let i = 0; i < KEPT; i++) {
    const file = bySize[Math.round((i * (bySize.length - 1)) / (KEPT - 1))];
    copyFileSync(join(merged, file), join(kept, file));
  }
}

/** Prints the line coverage of source files by the inputs of targets. */
async function countLines(env, { host, folder, found }, names) {
  const counted = await buildCounted(env, { host, folder, cargoArgs: CARGO_ARGS });
  const share = (files) => {
    const [covered, count] = ["covered", "count"].map((key) => files.reduce((sum, file) => sum + file[key], 0));
    return `${covered} of ${count} lines (${Math.round((100 * covered) / count)} %)`;
  };
  for (const name of names) {
    const files = await counted.ofTarget(name, [join(CORPUS, name), join(found, name)]);
    console.log(`  ${name}: ${share(files)} of ${files.length} files`);
  }
  const all = await counted.ofAll(names);
  for (const file of all) console.log(`  ${file.path}: ${share([file])}`);
  return share(all);
}

await main(async () => {
  const { values, positionals } = parseArgs({
    options: { minutes: { type: "string" }, keep: { type: "boolean" }, lines: { type: "boolean" } },
    allowPositionals: true,
  });
  const minutes = Number(values.minutes ?? DEFAULT_MINUTES);
  if (!(minutes > 0)) throw new Sentence(`Invalid minutes '${values.minutes}'. Expected a number above 0.`);
  const known = targets();
  const unknown = positionals.find((name) => !known.has(name));
  if (unknown) throw new Sentence(`Unknown target '${unknown}'. Known: ${[...known.keys()].join(", ")}.`);
  checkNode();
  const rust = await setupRust();
  await setupCxx();
  let built;
  await step("Building the fuzz targets", async () => {
    built = await build(rust);
  });
  const chosen = positionals.length > 0 ? positionals : [...known.keys()];
  const cores = Math.min(availableParallelism(), chosen.length);
  const secs = Math.max(1, Math.round((minutes * 60 * cores) / chosen.length));
  const results = [];
  await step(`Fuzzing ${chosen.length} targets for ${secs} s each`, async () => {
    const waiting = [...chosen];
    const work = async () => {
      for (let name = waiting.shift(); name; name = waiting.shift()) {
        const result = await fuzz(built, name, known.get(name), secs);
        results.push(result);
        const { failed, runs, edges, inputs } = result;
        const outcome = failed ? "FAILED" : "no finding";
        console.log(`  ${name}: ${runs} runs, ${edges} edges, ${inputs} inputs kept, ${outcome}`);
      }
    };
    await Promise.all(Array.from({ length: cores }, work));
    return `${results.reduce((sum, { runs }) => sum + runs, 0)} runs`;
  });
  const failed = results.filter((result) => result.failed);
  for (const { name, text } of failed) console.error(`── ${name}\n${text.slice(-4000)}`);
  if (failed.length > 0)
    throw new Sentence(`${failed.map(({ name }) => name).join(", ")} failed; the inputs are in rust/fuzz/corpus.`);
  if (values.keep)
    await step("Keeping the inputs that cover most code", async () => {
      for (const name of chosen) await keep(built, name);
    });
  if (values.lines) await step("Counting the lines that the inputs cover", () => countLines(rust, built, chosen));
  if (positionals.length > 0) return;
  await setupPackages();
  await step("Fuzzing the parsers of the page", () =>
    run(process.execPath, [join(root, "node_modules", "vitest", "vitest.mjs"), "run", "tests/fuzz"], {
      env: { STRUT_FUZZ_RUNS: String(Math.round(PAGE_RUNS * minutes)) },
    }),
  );
});
