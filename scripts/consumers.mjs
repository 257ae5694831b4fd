// npm run consumers [-- webpack rollup …]: installs the package of `npm run package` in projects of other bundlers,
// builds and opens their pages, and compares their styled motion with the command's. Prints a line for each. It needs
// the registry and several minutes; `npm test` has the tests that need neither.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { runnerImport } from "vite";
import { setupBrowser } from "./setup.mjs";
import { main, root, Sentence } from "./steps.mjs";

const FOLDER = join(root, "tests", "package");

await main(async () => {
  const { CHROME_PATH } = await setupBrowser();
  const { BUNDLERS, tryBundler } = (await runnerImport(join(FOLDER, "bundlers.ts"))).module;
  const { installPackage } = (await runnerImport(join(FOLDER, "consumer.ts"))).module;
  const names = process.argv.slice(2);
  const folders = BUNDLERS.map(({ folder }) => folder);
  const unknown = names.find((name) => !folders.includes(name));
  if (unknown) throw new Sentence(`Unknown consumer '${unknown}'. Known: ${folders.join(", ")}.`);
  if (!existsSync(join(root, "dist", "package"))) throw new Sentence("Run 'npm run package' first.");
  const chosen = BUNDLERS.filter(({ folder }) => names.length === 0 || names.includes(folder));
  const consumer = installPackage();
  const browser = await chromium.launch({ executablePath: CHROME_PATH, args: ["--no-sandbox"] });
  const failed = [];
  try {
    for (const bundler of chosen)
      if (!(await tryBundler(bundler, consumer, browser, console.log))) failed.push(bundler.folder);
  } finally {
    await browser.close();
    consumer.remove();
  }
  if (failed.length > 0) throw new Sentence(`The package does not work with ${failed.join(", ")}.`);
});
