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
 * Sets up the requirements and builds the WASM packages; see {@link buildPackages}. The npm packages are installed in the
 * meantime: the compiler does not need them.
 * @returns the environments in which cargo builds natively (`rust`) and for WebAssembly (`wasm`).
 */
export async function buildWasm(options) {
  checkNode();
  const rust = await setupRust();
  const wasm = await setupWasm(rust);
  const installed = setupPackages();
  await Promise.all([installed, buildPackages(wasm, { ...options, installed })]);
  return { rust, wasm };
}

/** Builds the page, without the rest of the site. Has the parameter and the result of {@link buildWasm}. */
export async function buildPage(options) {
  const environments = await buildWasm(options);
  await step("Building the page", () => run(process.execPath, [vite, "build", "--logLevel", "warn"]));
  return environments;
}

/**
 * Writes the rest of the site beside a built page in dist/: the package, the page for frames, licences and the documentation.
 * @param environments result of {@link buildPage}
 * @param options those of the page
 */
export async function buildRest(environments, options) {
  await step("Writing the package and the page for frames", async () => {
    await writePackage(options);
    await writeEmbedPage();
  });
  await step("Listing third-party licences", () => writeNotices(environments.rust));
  // A clean checkout installs its imports only after this file is read.
  await step("Writing the documentation", async () => (await import("./docs/site.mjs")).writeDocs());
}

/** Builds the static site. Has the parameter and the result of {@link buildWasm}. */
export async function buildSite(options) {
  const environments = await buildPage(options);
  await buildRest(environments, options);
  return environments;
}
