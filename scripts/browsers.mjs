// npm run browsers [-- -t Firefox]: user tasks of each view in Firefox (Debian's firefox-esr) and WebKit (Debian's
// webkit2gtk-driver), in a virtual display (xvfb). Missing programs are installed where apt is allowed. Needs the built
// site.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { checkNode, installDebian, setupPackages } from "./setup.mjs";
import { findProgram, main, root, run, Sentence, step } from "./steps.mjs";

/** Programs in each of Debian's packages. */
const PROGRAMS = {
  "firefox-esr": "firefox-esr",
  "webkit2gtk-driver": "WebKitWebDriver",
  xvfb: "xvfb-run",
  xauth: "xauth",
};

await main(async () => {
  checkNode();
  await setupPackages();
  if (!existsSync(join(root, "dist/index.html"))) throw new Sentence("dist/ is missing; run 'npm run build' first.");
  const missing = Object.keys(PROGRAMS).filter((name) => !findProgram(PROGRAMS[name]));
  if (missing.length > 0) await step(`Installing ${missing.join(", ")}`, () => installDebian(missing));
  if (!findProgram("xvfb-run"))
    throw new Sentence(`Install Debian's packages ${missing.join(", ")}, then run this again.`);
  const vitest = [
    join(root, "node_modules", "vitest", "vitest.mjs"),
    "run",
    "--config",
    "tests/browsers/vitest.config.ts",
  ];
  await step("The tasks in Firefox and WebKit", () =>
    run("xvfb-run", ["-a", "-s", "-screen 0 1440x900x24", process.execPath, ...vitest, ...process.argv.slice(2)]),
  );
});
