// Python and virtual environments with packages of fixed versions and hashes.
import { createHash } from "node:crypto";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { installDebian } from "./setup.mjs";
import { findProgram, output, run, Sentence, step } from "./steps.mjs";

const NAMES = ["python3", "python3.14", "python3.13", "python3.12", "python3.11", "python"];
const WINDOWS = process.platform === "win32";

/** Returns the path of a program of an environment. */
export const programIn = (environment, name) =>
  WINDOWS ? join(environment, "Scripts", `${name}.exe`) : join(environment, "bin", name);

/** Returns a Python that can create environments and is recent enough, or undefined. */
async function findPython() {
  const usable = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";
  for (const name of NAMES) {
    const path = findProgram(name);
    if (path && (await output(path, ["-c", usable])) !== undefined) return path;
  }
  return undefined;
}

/**
 * Finds Python, or installs Debian's. Without Python the step is skipped with a message; if `STRUT_PYTHON` is
 * `required` or `CI` is `true` it is an error.
 * @param what the step that needs Python, the beginning of that message
 * @returns its path, or undefined
 */
export async function setupPython(what) {
  const found = await findPython();
  if (found) return found;
  await step("Installing Python from Debian's packages", async () => {
    await installDebian(["python3", "python3-venv"]);
  });
  const python = await findPython();
  if (python) return python;
  const reason = "Python 3.11 or newer with its module venv was not found";
  if (process.env.STRUT_PYTHON === "required" || process.env.CI === "true")
    throw new Sentence(`${reason}. Install it, then run this again.`);
  console.log(`▸ ${what}: skipped, because ${reason}.`);
  return undefined;
}

/**
 * Creates an environment with the packages of a requirements file, with these versions and hashes. An up-to-date one is
 * kept.
 * @param label label of the step
 */
export async function setupEnvironment(python, { environment, requirements, label }) {
  const stamp = join(environment, ".strut-requirements");
  const hash = createHash("sha256").update(readFileSync(requirements)).digest("hex");
  if (existsSync(stamp) && readFileSync(stamp, "utf8") === hash) return;
  await step(label, async () => {
    await run(python, ["-m", "venv", "--clear", environment]);
    const options = ["--quiet", "--disable-pip-version-check", "--require-hashes", "--only-binary", ":all:"];
    await run(programIn(environment, "python"), ["-m", "pip", "install", ...options, "-r", requirements]);
    writeFileSync(stamp, hash);
  });
}
