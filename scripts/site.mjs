// Builds the static site in dist/ from the sources.
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
 * Sets up the requirements of the build.
 * @returns the environments in which cargo builds natively (`rust`) and for WebAssembly (`wasm`).
 */
async function setup() {
  checkNode();
  await setupPackages();
  const rust = await setupRust();
  return { rust, wasm: await setupWasm(rust) };
}

/** Builds the WASM packages; see {@link buildPackages}. Returns the result of {@link setup}. */
export async function buildWasm(options) {
  const environments = await setup();
  await buildPackages(environments.wasm, options);
  return environments;
}

/** Builds the static site. Has the parameter and the result of {@link buildWasm}. */
export async function buildSite(options) {
  const environments = await buildWasm(options);
  await step("Building the page", () => run(process.execPath, [vite, "build", "--logLevel", "warn"]));
  await step("Writing the package and the page for frames", async () => {
    await writePackage();
    await writeEmbedPage();
  });
  await step("Listing what is of others", () => writeNotices(environments.rust));
  // A clean checkout installs its imports only after this file is read.
  await step("Writing the documentation", async () => (await import("./docs/site.mjs")).writeDocs());
  return environments;
}
