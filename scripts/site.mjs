// From sources to the static site in dist/.
import { join } from "node:path";
import { checkNode, setupPackages, setupRust, setupWasm } from "./setup.mjs";
import { root, run, step } from "./steps.mjs";

/** Path of vite's command. */
export const vite = join(root, "node_modules", "vite", "bin", "vite.js");

/** Builds one of xtask's packages for WebAssembly. */
async function xtask(wasm, word) {
  await run(wasm.CARGO ?? "cargo", ["run", "--profile", "tool", "--quiet", "-p", "xtask", "--", word], {
    env: wasm,
    cwd: join(root, "rust"),
  });
}

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

/** Builds the WASM packages and the built-in motions; returns what {@link setup} does. */
export async function buildWasm() {
  const environments = await setup();
  await step("Building the engine for WebAssembly", () => xtask(environments.wasm, "wasm"));
  await step("Performing the built-in motions", () => xtask(environments.wasm, "motions"));
  return environments;
}

/** Builds the engine with what benchmarks need, with and without SIMD. */
export async function buildBench() {
  const { wasm } = await setup();
  await step("Building the benchmarks for WebAssembly", () => xtask(wasm, "bench"));
}

/** Builds the static site; returns what {@link buildWasm} does. */
export async function buildSite() {
  const environments = await buildWasm();
  await step("Building the page", () => run(process.execPath, [vite, "build", "--logLevel", "warn"]));
  return environments;
}
