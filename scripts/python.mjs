// The Python package: node scripts/python.mjs builds its wheel, installs that and runs its tests. A step of npm test.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { installDebian, setupRust } from "./setup.mjs";
import { findProgram, main, output, root, run, Sentence, step } from "./steps.mjs";

const PACKAGE = join(root, "rust", "strut-python");
const TARGET = join(root, "rust", "target", "python");
const WHEELS = join(TARGET, "wheels");
const VENV = join(TARGET, "venv");
/** The command as the Rust tests built it. */
const COMMAND = join(root, "rust", "target", "debug", "strut");
/** Greatest size of the wheel, bytes. */
const MAX_WHEEL = 1_600_000;
const NAMES = ["python3", "python3.14", "python3.13", "python3.12", "python3.11"];

const inVenv = (name) => join(VENV, "bin", name);

/** A Python that can make environments and is recent enough; undefined if there is none. */
async function findPython() {
  const usable = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";
  for (const name of NAMES) {
    const path = findProgram(name);
    if (path && (await output(path, ["-c", usable])) !== undefined) return path;
  }
  return undefined;
}

/** Finds Python, or installs Debian's. */
async function setupPython() {
  const python = await findPython();
  if (python) return python;
  await step("Installing Python from Debian's packages", async () => {
    await installDebian(["python3", "python3-venv"]);
  });
  return findPython();
}

/** An environment with what builds and tests the package, of the versions and hashes of requirements.txt. */
async function setupEnvironment(python) {
  const requirements = join(PACKAGE, "requirements.txt");
  const stamp = join(VENV, ".strut-requirements");
  const hash = createHash("sha256").update(readFileSync(requirements)).digest("hex");
  if (existsSync(stamp) && readFileSync(stamp, "utf8") === hash) return;
  await step("Installing what the Python package is built and tested with", async () => {
    await run(python, ["-m", "venv", "--clear", VENV]);
    const options = ["--quiet", "--disable-pip-version-check", "--require-hashes", "--only-binary", ":all:"];
    await run(inVenv("python"), ["-m", "pip", "install", ...options, "-r", requirements]);
    writeFileSync(stamp, hash);
  });
}

async function buildWheel(env) {
  rmSync(WHEELS, { recursive: true, force: true });
  await run(inVenv("maturin"), ["build", "--quiet", "--locked", "--out", WHEELS], { env, cwd: PACKAGE });
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
}

/** Builds and tests the package. Without Python that is left out, and an error where STRUT_PYTHON or CI say so. */
export async function checkPython(env) {
  const python = await setupPython();
  if (!python) {
    const reason = "Python 3.11 or newer with its module venv was not found";
    if (process.env.STRUT_PYTHON === "required" || process.env.CI === "true")
      throw new Sentence(`${reason}. Install it, then run this again.`);
    console.log(`▸ Python package: left out, as ${reason}.`);
    return;
  }
  await setupEnvironment(python);
  await step("Python package", () => buildWheel(env));
  await step("Python tests, types and stubs", () => testPackage(env));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main(async () => checkPython(await setupRust()));
