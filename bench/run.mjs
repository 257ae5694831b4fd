// npm run bench -- [--frames N | --db DB] [--json FILE] [--write | --clips | --large | --gpu]: builds what is measured
// and measures it in Node.
// With --write it also measures natively at several sizes, with both sources if --db is given, and writes
// docs/performance.md. With --clips it measures instead the time for a whole clip of a minute, with --large a database
// of a million frames. With --gpu it measures natively, and compares with the paper's search on the GPU: Node has no
// WebGPU.
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { runnerImport } from "vite";
import { setupRust } from "../scripts/setup.mjs";
import { buildWasm } from "../scripts/site.mjs";
import { main, root, run, Sentence, step } from "../scripts/steps.mjs";

/** Smallest number of frames of a procedural database. */
const LEAST_FRAMES = 4800;
/** Numbers of frames that are measured natively for the page. */
const SIZES = "20000,79829,400000,1600000";

/** Returns a path relative to the folder in which the user typed it. */
const path = (name) => resolve(process.env.INIT_CWD ?? ".", name);

/** Builds the command, with features or without. */
async function buildCommand(...features) {
  const rust = await setupRust();
  const env = { env: rust, cwd: join(root, "rust") };
  const build = [
    "build",
    "--release",
    "--quiet",
    "-p",
    "strut-motion-cli",
    ...features.flatMap((name) => ["--features", name]),
  ];
  await step("Building the command", () => run(rust.CARGO ?? "cargo", build, env));
  return join(root, "rust", "target", "release", "strut");
}

/** Measures with the command, including the paper's search on the GPU. */
async function measureGraphics({ frames, db, json }) {
  const strut = await buildCommand("gpu");
  const options = [frames && ["--frames", frames], db && ["--db", path(db)], json && ["--json", path(json)]];
  await run(strut, ["bench", "--gpu", ...options.filter(Boolean).flat()]);
}

/** Builds the command and measures with it. */
async function measureNatively() {
  const strut = await buildCommand();
  const json = join(mkdtempSync(join(tmpdir(), "strut-bench-")), "native.json");
  const command = ["bench", "--frames", SIZES];
  await step("Measuring natively", () => run(strut, [...command, "--json", json]));
  return { command: ["strut", ...command].join(" "), report: JSON.parse(readFileSync(json, "utf8")) };
}

/** Writes a file with the procedural database of this number of frames, too large to be made in WebAssembly. */
async function writeDatabase(frames) {
  const rust = await setupRust();
  const file = join(mkdtempSync(join(tmpdir(), "strut-bench-")), "large.strutdb");
  const example = ["run", "--release", "--quiet", "-p", "strut-motion-demo", "--example", "benchmark_database", "--"];
  await step(`Writing a database of ${frames} frames`, () =>
    run(rust.CARGO ?? "cargo", [...example, String(frames), file], { env: rust, cwd: join(root, "rust") }),
  );
  return file;
}

await main(async () => {
  const { values } = parseArgs({
    options: {
      frames: { type: "string" },
      db: { type: "string" },
      json: { type: "string" },
      write: { type: "boolean", default: false },
      clips: { type: "boolean", default: false },
      large: { type: "boolean", default: false },
      gpu: { type: "boolean", default: false },
    },
  });
  if (values.db && values.frames) throw new Sentence("--db and --frames exclude each other.");
  if (values.db && !existsSync(path(values.db))) throw new Sentence(`${values.db}: there is no such file.`);
  if (values.gpu) return measureGraphics(values);
  await buildWasm({ mode: "full", bench: "full" });
  const { module: bench } = await runnerImport(join(root, "bench", "node.ts"));
  const frames = Number(values.frames ?? (values.large ? bench.LARGE_FRAMES : bench.PAPER_FRAMES));
  if (!Number.isInteger(frames) || frames < LEAST_FRAMES)
    throw new Sentence(`--frames is '${values.frames}'; a whole number of at least ${LEAST_FRAMES} was expected.`);

  if (values.clips) {
    const rows = await bench.clipsInNode(values.db ? { database: readFileSync(path(values.db)) } : { frames });
    console.log(bench.clipLines(rows));
    if (values.json) writeFileSync(path(values.json), `${JSON.stringify(rows, null, 2)}\n`);
    return;
  }

  const measureLarge = async (frames) => {
    const file = await writeDatabase(frames);
    const report = await bench.largeInNode(readFileSync(file));
    rmSync(dirname(file), { recursive: true });
    console.log(`\n${bench.largeLines(report)}\n`);
    return report;
  };
  if (values.large) {
    if (values.db) throw new Sentence("--large makes a database of its own; give --frames.");
    const report = await measureLarge(frames);
    if (values.json) writeFileSync(path(values.json), `${JSON.stringify(report, null, 2)}\n`);
    return;
  }

  let last = "";
  const onProgress = (what) => {
    if (what !== last) console.log(`  ${what}`);
    last = what;
  };
  const measure = async (command, source) => {
    const report = await bench.benchmarkInNode(source, onProgress);
    console.log(`\n${bench.text(report)}\n`);
    return { command, report };
  };
  const recorded =
    values.db &&
    (await measure(`npm run bench -- --db ${basename(values.db)}`, { database: readFileSync(path(values.db)) }));
  const procedural = (values.write || !recorded) && (await measure(`npm run bench -- --frames ${frames}`, { frames }));
  if (values.json) {
    const { report } = recorded || procedural;
    writeFileSync(path(values.json), `${JSON.stringify(report, null, 2)}\n`);
  }
  if (values.write) {
    const date = new Date().toISOString().slice(0, 10);
    const large = { command: "npm run bench -- --large", report: await measureLarge(bench.LARGE_FRAMES) };
    const page = bench.document(date, procedural, recorded, large, await measureNatively());
    writeFileSync(join(root, "docs", "performance.md"), page);
    console.log("docs/performance.md is written");
  }
});
