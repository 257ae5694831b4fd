// Prints the report of a WASM build of rust/strut-wasm/src/engine/parity.rs, as the native example `parity` does:
// node report.mjs simd|scalar [--nudge FRAME] [FILE.bvh …]
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { parseArgs } from "node:util";

const { values, positionals } = parseArgs({ options: { nudge: { type: "string" } }, allowPositionals: true });
const [build, ...files] = positionals;
const folder = new URL(`../../bench/pkg/${build}/`, import.meta.url);
const glue = await import(new URL("strut_bench.js", folder).href);
glue.initSync({ module: readFileSync(new URL("strut_bench_bg.wasm", folder)) });
const report = new glue.ParityReport();
for (const path of files) report.addFile(basename(path), readFileSync(path));
process.stdout.write(report.run(values.nudge === undefined ? undefined : Number(values.nudge)));
