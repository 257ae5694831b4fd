// npm run docs: what is generated in docs/, and the site in dist/docs/. With --check nothing in docs/ is written: what is
// generated must be as it is committed, and links, code blocks and sizes as they should be. --prose lists long sentences.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { linkFaults, sizes } from "./docs/check.mjs";
import { generatedFaults, writeGenerated } from "./docs/generated.mjs";
import { longSentences } from "./docs/prose.mjs";
import { writeDocs } from "./docs/site.mjs";
import { setupRust } from "./setup.mjs";
import { buildSite } from "./site.mjs";
import { main, root, run, Sentence, step } from "./steps.mjs";

/** The command, as the Rust tests build it. */
const COMMAND = join(root, "rust", "target", "debug", "strut");

/** The reference is that of the present sources. */
async function buildCommand() {
  const env = await setupRust();
  await step("Building the command", () =>
    run(env.CARGO ?? "cargo", ["build", "--quiet", "--profile", "test", "-p", "strut-cli"], {
      env,
      cwd: join(root, "rust"),
    }),
  );
}

await main(async () => {
  if (process.argv.includes("--prose")) {
    console.log(longSentences().join("\n"));
    return;
  }
  const isCheck = process.argv.includes("--check");
  // The components on the pages are those of the site.
  if (!existsSync(join(root, "dist", "index.html"))) await buildSite({ mode: "quick", bench: "quick" });
  await buildCommand();
  if (!isCheck) await step("Writing what is generated", () => writeGenerated(COMMAND));
  await step("Writing the documentation", writeDocs);
  if (!isCheck) return;
  await step("Checking the documentation", async () => {
    const { faults, report } = sizes();
    const all = [...(await generatedFaults(COMMAND)), ...linkFaults(), ...faults];
    if (all.length > 0) throw new Sentence(`the documentation is not as it should be:\n  ${all.join("\n  ")}`);
    return report;
  });
});
