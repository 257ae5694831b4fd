// npm run mutations [-- NUMBER …]: checks that the tests of faults can fail. Removes one handler of the product at a
// time, builds the page and runs the test of that fault, which must fail; then restores everything. Not part of the
// tests: it takes about a minute per handler.
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { vite } from "./site.mjs";
import { main, output, root, run, Sentence } from "./steps.mjs";

const FAULTS = "tests/e2e/faults";

/** Mutations: in `file`, `from` becomes `to`; the test of `spec` whose title contains `title` must then fail. */
const MUTATIONS = [
  {
    handler: "a worker's error has another worker take its place",
    file: "web/client/connection.ts",
    from: "onFail: (error) => isLoaded && this.replace(error)",
    to: "onFail: () => {}",
    spec: `${FAULTS}/engine.test.ts`,
    title: "while a dropped file is opened",
  },
  {
    handler: "code that the browser refuses is no bug",
    file: "web/client/connection.ts",
    from: 'if (error.code !== "fault") return error;',
    to: "if (error) return error;",
    spec: `${FAULTS}/engine.test.ts`,
    title: "WebAssembly is forbidden",
  },
  {
    handler: "a worker that builds may end",
    file: "web/client/rpc_client.ts",
    from: "if (this.#worker === worker) this.#worker = undefined",
    to: "if (this.#worker !== worker) this.#worker = undefined",
    spec: `${FAULTS}/build.test.ts`,
    title: "while it builds: the clips stay",
  },
  {
    handler: "what was being trained for a view that is hidden is asked for again",
    file: "web/app/views/synthesis/model_loader.ts",
    from: "    this.#pending = undefined;\n    this.#options.cancel();",
    to: "    this.#options.cancel();",
    spec: `${FAULTS}/build.test.ts`,
    title: "it is trained when the view is shown again",
  },
  {
    handler: "after a stall the motion goes on where it was",
    file: "web/player/clock.ts",
    from: "return Math.min(Math.max(0, (now - before) / 1000), LONGEST_STEP_SECS);",
    to: "return Math.max(0, (now - before) / 1000, 0 * LONGEST_STEP_SECS);",
    spec: `${FAULTS}/lifetime.test.ts`,
    title: "the walk goes on where it was",
  },
  {
    handler: "a page that the browser keeps is not taken apart",
    file: "web/app/main.ts",
    from: "if (!persisted) app.dispose();",
    to: "if (persisted || !persisted) app.dispose();",
    spec: `${FAULTS}/lifetime.test.ts`,
    title: "hears that it was kept",
  },
  {
    handler: "a picture that does not come back is said to be lost",
    file: "web/app/shell/shared_viewer.ts",
    from: "wait = setTimeout(() => onLost(true), LOST_MS);",
    to: "wait = setTimeout(() => onLost(false), LOST_MS);",
    spec: `${FAULTS}/lifetime.test.ts`,
    title: "leaves motion and settings",
  },
  {
    handler: "what a newer tab keeps asks for a reload",
    file: "web/app/views/data/saved_databases.ts",
    from: 'if (error?.name === "VersionError")',
    to: 'if (error?.name === "")',
    spec: `${FAULTS}/storage.test.ts`,
    title: "of which one is newer",
  },
  {
    handler: "a database that the disk gives late does not overtake another",
    file: "web/app/shell/databases.ts",
    from: "    const source = await this.#wanted(name);\n    if (request !== this.#requests) return;\n",
    to: "    const source = await this.#wanted(name);\n",
    spec: `${FAULTS}/storage.test.ts`,
    title: "that the disk gives late",
  },
  {
    handler: "a build does not wait for the answer of a person",
    file: "web/app/views/data/saved_databases.ts",
    from: "void askToPersist();",
    to: "await askToPersist();",
    spec: `${FAULTS}/storage.test.ts`,
    title: "keeps no build waiting",
  },
  {
    handler: "a list that did not come is asked for again",
    file: "web/app/views/data/catalogue_panel.ts",
    from: "this.#again.hidden = this.#entries.length > 0;",
    to: "this.#again.hidden = this.#entries.length >= 0;",
    spec: `${FAULTS}/network.test.ts`,
    title: "that is damaged: a sentence",
  },
];

/** Timeout of a test's waits, milliseconds: all of these tests must fail. */
const PATIENCE_MS = 40_000;

const build = () => run(process.execPath, [vite, "build", "--logLevel", "error"]);

/** Runs a test of a file. Returns whether it failed; throws a message if there is no such test. */
function fails(spec, title) {
  const vitest = join(root, "node_modules", "vitest", "vitest.mjs");
  const pattern = title.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
  const args = [vitest, "run", "--project", "browser", spec, "-t", pattern, "--reporter=json"];
  const env = { ...process.env, STRUT_PATIENCE_MS: String(PATIENCE_MS) };
  const { stdout } = spawnSync(process.execPath, args, { cwd: root, env, encoding: "utf8", maxBuffer: 1 << 28 });
  const { numPassedTests, numFailedTests } = JSON.parse(stdout.slice(stdout.indexOf("{")));
  if (numPassedTests + numFailedTests === 0) throw new Sentence(`${spec} has no test “${title}”.`);
  return numFailedTests > 0;
}

/** Builds without a handler and runs its test. Returns whether the test failed. */
async function isNoticed({ file, from, to, spec, title }) {
  const path = join(root, file);
  const source = readFileSync(path, "utf8");
  if (source.split(from).length !== 2) throw new Sentence(`${file} must contain this text exactly once: ${from}`);
  writeFileSync(
    path,
    source.replace(from, () => to),
  );
  try {
    await build();
    return fails(spec, title);
  } finally {
    writeFileSync(path, source);
  }
}

await main(async () => {
  const asked = process.argv.slice(2).map(Number);
  const chosen = MUTATIONS.filter((_, i) => asked.length === 0 || asked.includes(i + 1));
  const changed = await output("git", ["status", "--porcelain", ...new Set(chosen.map(({ file }) => file))]);
  if (changed)
    throw new Sentence(`Commit these files first, because the mutations change and restore them:\n${changed}`);
  const [dist, kept] = [join(root, "dist"), mkdtempSync(join(tmpdir(), "strut-dist-"))];
  cpSync(dist, kept, { recursive: true });
  const unnoticed = [];
  try {
    for (const mutation of chosen) {
      const noticed = await isNoticed(mutation);
      console.log(`${noticed ? "✓ noticed" : "✗ not noticed"}: without “${mutation.handler}”, ${mutation.spec}`);
      if (!noticed) unnoticed.push(mutation.handler);
    }
  } finally {
    rmSync(dist, { recursive: true });
    cpSync(kept, dist, { recursive: true });
    rmSync(kept, { recursive: true });
  }
  if (unnoticed.length > 0) throw new Sentence(`No test fails without: ${unnoticed.join("; ")}.`);
});
