// npm run docs: writes the generated parts of docs/, and the site in dist/docs/. With --check nothing in docs/ is
// written: generated parts must equal the committed ones, and links, code blocks and sizes are checked. --prose lists
// long sentences.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { checkNode, setupPackages, setupRust } from "./setup.mjs";
import { buildSite } from "./site.mjs";
import { main, root, run, Sentence, step } from "./steps.mjs";

/** The command, as the Rust tests build it. */
const COMMAND = join(root, "rust", "target", "debug", "strut");

/** Builds the command, so that the reference is that of the present sources. */
async function buildCommand() {
  const env = await setupRust();
  await step("Building the command", () =>
    run(env.CARGO ?? "cargo", ["build", "--quiet", "--profile", "test", "-p", "strut-motion-cli"], {
      env,
      cwd: join(root, "rust"),
    }),
  );
}

async function checkDocs() {
  const { linkFaults, sizes } = await import("./docs/check.mjs");
  const { generatedFaults } = await import("./docs/generated.mjs");
  const { faults, report } = sizes();
  const all = [...(await generatedFaults(COMMAND)), ...linkFaults(), ...faults];
  if (all.length > 0) throw new Sentence(`the documentation has faults:\n  ${all.join("\n  ")}`);
  return report;
}

await main(async () => {
  checkNode();
  await setupPackages();
  if (process.argv.includes("--prose")) {
    const { longSentences } = await import("./docs/prose.mjs");
    console.log(longSentences().join("\n"));
    return;
  }
  // The components on the pages are those of the site.
  if (!existsSync(join(root, "dist", "index.html"))) await buildSite({ mode: "quick", bench: "quick" });
  await buildCommand();
  const isCheck = process.argv.includes("--check");
  if (!isCheck) {
    const { writeGenerated } = await import("./docs/generated.mjs");
    await step("Writing the generated parts", () => writeGenerated(COMMAND));
  }
  const { writeDocs } = await import("./docs/site.mjs");
  await step("Writing the documentation", writeDocs);
  if (isCheck) await step("Checking the documentation", checkDocs);
});
