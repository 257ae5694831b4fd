// npm start [-- --port N]: sets up, builds and serves the playground.
import { parseArgs } from "node:util";
import { buildPage, buildRest, vite } from "./site.mjs";
import { main, run, Sentence } from "./steps.mjs";

await main(async () => {
  const { values } = parseArgs({ options: { port: { type: "string", default: "5173" } } });
  const port = Number(values.port);
  if (!Number.isInteger(port) || port < 1 || port > 65535)
    throw new Sentence(`Invalid port '${values.port}'. Expected a number from 1 to 65535.`);
  const mode = { mode: "quick" };
  const environments = await buildPage(mode);
  console.log(`\nStrut is at http://localhost:${port}  (Ctrl+C stops it)\n`);
  process.on("SIGINT", () => {});
  // The page is served while the rest is written.
  await Promise.all([
    run(process.execPath, [vite, "preview", "--port", String(port), "--strictPort", "--logLevel", "warn"]),
    buildRest(environments, mode),
  ]);
});
