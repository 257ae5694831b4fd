// npm run build: the static site in dist/, which works from any folder of any host.
import { buildSite } from "./site.mjs";
import { main } from "./steps.mjs";

await main(async () => {
  await buildSite({ mode: "full", bench: "full" });
});
