// npm run bench -- [--frames N | --db DB] [--json FILE]: builds what is measured and measures it in Node.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { runnerImport } from "vite";
import { buildBench } from "../scripts/site.mjs";
import { main, root, Sentence } from "../scripts/steps.mjs";

/** A path as the person who typed it meant it. */
const path = (name) => resolve(process.env.INIT_CWD ?? ".", name);

await main(async () => {
  const { values } = parseArgs({
    options: { frames: { type: "string" }, db: { type: "string" }, json: { type: "string" } },
  });
  if (values.db && values.frames) throw new Sentence("--db and --frames exclude each other.");
  if (values.db && !existsSync(path(values.db))) throw new Sentence(`${values.db}: there is no such file.`);
  await buildBench();
  const { module: bench } = await runnerImport(join(root, "bench", "node.ts"));
  const frames = Number(values.frames ?? bench.PAPER_FRAMES);
  if (!Number.isInteger(frames) || frames < 4800)
    throw new Sentence(`--frames is '${values.frames}'; a whole number of at least 4800 was expected.`);
  const source = values.db ? { database: new Uint8Array(readFileSync(path(values.db))) } : { frames };
  let last = "";
  const report = await bench.benchmarkInNode(source, (what) => {
    if (what !== last) console.log(`  ${what}`);
    last = what;
  });
  console.log(`\n${bench.text(report)}\n`);
  if (values.json) writeFileSync(path(values.json), `${JSON.stringify(report, null, 2)}\n`);
});
