// From sources to the static site in dist/.
import { join } from "node:path";
import { checkNode, setupPackages, setupRust, setupWasm } from "./setup.mjs";
import { root, run, step } from "./steps.mjs";

/** Path of vite's command. */
export const vite = join(root, "node_modules", "vite", "bin", "vite.js");

/**
 * Sets up what the build needs and builds the WASM package.
 * @returns the environments in which cargo builds natively (`rust`) and for WebAssembly (`wasm`).
 */
export async function buildWasm() {
  checkNode();
  await setupPackages();
  const rust = await setupRust();
  const wasm = await setupWasm(rust);
  await step("Building the engine for WebAssembly", () =>
    run(wasm.CARGO ?? "cargo", ["run", "--profile", "tool", "--quiet", "-p", "xtask", "--", "wasm"], {
      env: wasm,
      cwd: join(root, "rust"),
    }),
  );
  return { rust, wasm };
}

/** Builds the static site; returns what {@link buildWasm} does. */
export async function buildSite() {
  const environments = await buildWasm();
  await step("Building the page", () => run(process.execPath, [vite, "build", "--logLevel", "warn"]));
  return environments;
}
