// npm run package: builds the package `strut-motion`, fully optimised, in dist/package/.
import { checkPackageSize, writePackage } from "./package.mjs";
import { buildWasm } from "./site.mjs";
import { main, step } from "./steps.mjs";

await main(async () => {
  await buildWasm({ mode: "full" });
  await step("Writing the package", async () => {
    await writePackage({ mode: "full" });
    return checkPackageSize();
  });
});
