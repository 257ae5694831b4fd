// npm test: sets up all requirements and runs every test: Rust, Python, TypeScript, parity, end to end in Chromium.
import { join } from "node:path";
import { keepCompiled, takeCompiled } from "./compiled_rust.mjs";
import { checkPython } from "./python.mjs";
import { setupBrowser, softwareGraphics } from "./setup.mjs";
import { buildSite } from "./site.mjs";
import { main, root, run, step } from "./steps.mjs";

await main(async () => {
  const { rust, wasm } = await buildSite({ mode: "quick", bench: "quick" });
  const browser = await setupBrowser();
  const env = { ...rust, ...softwareGraphics(browser.CHROME_PATH) };
  await step("Rust tests", async () => {
    await takeCompiled(rust);
    await run(rust.CARGO ?? "cargo", ["tests", "--quiet"], { env, cwd: join(root, "rust") });
    await keepCompiled(rust);
  });
  await checkPython(rust);
  await step("TypeScript, parity and browser tests", () =>
    run(process.execPath, [join(root, "node_modules", "vitest", "vitest.mjs"), "run"], {
      env: { ...wasm, ...browser },
    }),
  );
});
