// npm run strut -- ARGS: builds the command and runs it with these arguments.
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { setupRust } from "./setup.mjs";
import { root, run } from "./steps.mjs";

const rust = await setupRust();
await run(rust.CARGO ?? "cargo", ["build", "--release", "--quiet", "-p", "strut-motion-cli"], {
  env: rust,
  cwd: join(root, "rust"),
});
const command = join(root, "rust", "target", "release", "strut");
const { status } = spawnSync(command, process.argv.slice(2), { stdio: "inherit", cwd: process.env.INIT_CWD ?? root });
process.exitCode = status ?? 1;
