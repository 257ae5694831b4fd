// From sources to the static site in dist/.
import { join } from "node:path";
import { writeEmbedPage } from "./embed_page.mjs";
import { writeNotices } from "./notices.mjs";
import { writePackage } from "./package.mjs";
import { checkNode, setupPackages, setupRust, setupWasm } from "./setup.mjs";
import { root, run, step } from "./steps.mjs";
import { buildPackages } from "./wasm.mjs";

/** Path of vite's command. */
export const vite = join(root, "node_modules", "vite", "bin", "vite.js");

/**
 * Sets up what the build needs.
 * @returns the environments in which cargo builds natively (`rust`) and for WebAssembly (`wasm`).
 */
async function setup() {
  checkNode();
  await setupPackages();
  const rust = await setupRust();
  return { rust, wasm: await setupWasm(rust) };
}

/** Builds the WASM packages; see {@link buildPackages}. Returns what {@link setup} does. */
export async function buildWasm(options) {
  const environments = await setup();
  await buildPackages(environments.wasm, options);
  return environments;
}

/** Builds the static site; takes and returns what {@link buildWasm} does. */
export async function buildSite(options) {
  const environments = await buildWasm(options);
  await step("Building the page", () => run(process.execPath, [vite, "build", "--logLevel", "warn"]));
  await step("Writing the package and the page for frames", async () => {
    await writePackage();
    await writeEmbedPage();
  });
  await step("Listing what is of others", () => writeNotices(environments.rust));
  // A clean checkout installs what it imports after this file is read.
  await step("Writing the documentation", async () => (await import("./docs/site.mjs")).writeDocs());
  return environments;
}
