// The Python package: node scripts/python.mjs builds its wheel, installs it and runs its tests. A step of npm test.
import { existsSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { keepBuilt, sourcesHash, takeBuilt } from "./build_cache.mjs";
import { programIn, setupEnvironment, setupPython } from "./python_environment.mjs";
import { setupRust } from "./setup.mjs";
import { main, root, run, Sentence, step } from "./steps.mjs";

const PACKAGE = join(root, "rust", "strut-python");
const TARGET = join(root, "rust", "target", "python");
/** Folder of the wheel. */
export const WHEELS = join(TARGET, "wheels");
const VENV = join(TARGET, "venv");
/** The command, built by the Rust tests. */
const COMMAND = join(root, "rust", "target", "debug", "strut");
/**
 * Greatest size of the wheel, bytes. Reading files of other programs, and reporting how, takes 40 kB of it; messages that
 * name the limit and the next step, and temporary files for traces, 24 kB.
 */
const MAX_WHEEL = 2_500_000;
const inVenv = (name) => programIn(VENV, name);

async function buildWheel(env) {
  const source = (name) => join(PACKAGE, name);
  const python = readdirSync(source("python/strut")).filter((name) => /\.pyi?$/.test(name));
  const key = await sourcesHash(env, {
    left: ["fuzz", "xtask"],
    files: [
      fileURLToPath(import.meta.url),
      ...["requirements.txt", "pyproject.toml"].map(source),
      ...python.map((name) => source(`python/strut/${name}`)),
    ],
    texts: [process.platform, process.arch],
  });
  if (!takeBuilt(key, "wheel", WHEELS)) {
    rmSync(WHEELS, { recursive: true, force: true });
    await run(inVenv("maturin"), ["build", "--quiet", "--locked", "--out", WHEELS], { env, cwd: PACKAGE });
    keepBuilt(key, "wheel", WHEELS);
  }
  const [name] = readdirSync(WHEELS);
  const bytes = readFileSync(join(WHEELS, name)).length;
  if (bytes > MAX_WHEEL) throw new Sentence(`The wheel has ${bytes} bytes; at most ${MAX_WHEEL} are allowed.`);
  const options = ["--quiet", "--disable-pip-version-check", "--no-deps", "--force-reinstall"];
  await run(inVenv("python"), ["-m", "pip", "install", ...options, join(WHEELS, name)]);
  return `${name}, ${Math.round(bytes / 1000)} kB`;
}

async function testPackage(env) {
  if (!existsSync(COMMAND))
    await run(env.CARGO ?? "cargo", ["build", "--quiet", "--profile", "test", "-p", "strut-motion-cli"], {
      env,
      cwd: join(root, "rust"),
    });
  const inPackage = { env: { ...env, STRUT_COMMAND: COMMAND, PYTHONDONTWRITEBYTECODE: "1" }, cwd: PACKAGE };
  const python = (...args) => run(inVenv("python"), ["-m", ...args], inPackage);
  await python("pytest", "-p", "no:cacheprovider");
  await python("mypy", "--cache-dir", join(TARGET, "mypy"), "-p", "strut");
  await python("mypy.stubtest", "strut");
  await run(join(root, "node_modules", ".bin", "pyright"), ["--pythonpath", inVenv("python")], inPackage);
}

/** Builds the wheel with this Python, and installs it in the environment of its tests. */
export async function buildPythonWheel(python, env) {
  await setupEnvironment(python, {
    environment: VENV,
    requirements: join(PACKAGE, "requirements.txt"),
    label: "Installing what the Python package is built and tested with",
  });
  await step("Python package", () => buildWheel(env));
}

/** Builds and tests the package. Without Python this is skipped; with STRUT_PYTHON or CI it is an error. */
export async function checkPython(env) {
  const python = await setupPython("Python package");
  if (!python) return;
  await buildPythonWheel(python, env);
  await step("Python tests, types and stubs", () => testPackage(env));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main(async () => checkPython(await setupRust()));
