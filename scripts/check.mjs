// npm run check: formatting, lints, types, architecture, size budget.
import { join } from "node:path";
import { checkArchitecture } from "./architecture.mjs";
import { takeCompiled } from "./compiled_rust.mjs";
import { checkPackageSize } from "./package.mjs";
import { versionFaults } from "./release/versions.mjs";
import { checkNode, setupCxx, setupPackages, setupRust } from "./setup.mjs";
import { buildSite } from "./site.mjs";
import { checkSize } from "./size.mjs";
import { findProgram, main, output, root, run, Sentence, step } from "./steps.mjs";
import { checkWorkflows } from "./workflows.mjs";

/** Features that tests, benchmarks and fuzzing need in addition to the page's. */
const FEATURES = "strut-wasm/all,strut-motion-cli/gpu,strut-fuzz/libfuzzer";

const bin = (name) => join(root, "node_modules", ".bin", name);

/** Adds rustfmt and clippy, which rustup's minimal profile omits. */
async function setupLints(env) {
  if (
    (await output("cargo", ["clippy", "--version"], { env })) &&
    (await output("cargo", ["fmt", "--version"], { env }))
  )
    return;
  if (findProgram("rustup"))
    await step("Adding rustfmt and clippy with rustup", () => run("rustup", ["component", "add", "rustfmt", "clippy"]));
}

await main(async () => {
  await step("Architecture", checkArchitecture);
  await step("Versions", async () => {
    const faults = versionFaults();
    if (faults.length > 0) throw new Sentence(faults.join("\n"));
  });
  await step("Workflows and citation", checkWorkflows);
  // Checks that take seconds run before the build, which takes minutes.
  checkNode();
  await setupPackages();
  await step("TypeScript formatting and lints", () => run(bin("biome"), ["ci", "--error-on-warnings", "."]));
  const env = await setupRust();
  await setupLints(env);
  await setupCxx();
  // Lints of the Python package do not need Python.
  const withoutPython = { PYO3_BUILD_EXTENSION_MODULE: "1", PYO3_NO_PYTHON: "1" };
  const rust = { env: { ...env, ...withoutPython }, cwd: join(root, "rust") };
  await step("Rust formatting", () => run("cargo", ["fmt", "--all", "--check"], rust));
  await step("Rust lints", async () => {
    await takeCompiled(env);
    const lints = ["--quiet", "--", "-D", "warnings"];
    await run("cargo", ["clippy", "--workspace", "--all-targets", "--features", FEATURES, ...lints], rust);
    // The crate as a page starts with it.
    await run("cargo", ["clippy", "--package", "strut-wasm", "--features", "engine", ...lints], rust);
  });
  await buildSite({ mode: "full", bench: "quick" });
  await step("TypeScript types", async () => {
    await run(bin("tsc"), ["-p", "."]);
    // A service worker has other globals than a page.
    await run(bin("tsc"), ["-p", "web/app/offline"]);
  });
  await step("Size budget of the page", checkSize);
  await step("The package's size budget", async () => {
    return checkPackageSize();
  });
});
