// Artefacts of a release, all built into one folder: the command, Python's wheel and source distribution, the npm
// package and the crates.
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { writePackage } from "../package.mjs";
import { programIn, setupEnvironment, setupPython } from "../python_environment.mjs";
import { setupRust } from "../setup.mjs";
import { buildWasm } from "../site.mjs";
import { output, root, run, Sentence } from "../steps.mjs";
import { currentVersion } from "./versions.mjs";

const RUST = join(root, "rust");
const PYTHON = join(RUST, "strut-python");

/** In the order of publishing: each needs only those before it. */
export const CRATES = ["core", "evaluation", "formats", "demo", "gpu", "tasks", "cli"].map(
  (name) => `strut-motion-${name}`,
);

/** Kinds of artefacts, and the functions that write them into a folder. */
export const ARTEFACTS = { command, wheel, sdist, npm, crates };

const cargoOf = (rust) => rust.CARGO ?? "cargo";

/** Returns the default target of rustc. */
async function hostTarget(rust) {
  const version = await output(rust.RUSTC ?? "rustc", ["-vV"], { env: rust });
  const target = /^host: (.*)$/m.exec(version ?? "")?.[1];
  if (!target) throw new Sentence("rustc does not report its host target.");
  return target;
}

/** Writes an archive with the command and the licences. */
async function command(out) {
  const rust = await setupRust();
  const target = await hostTarget(rust);
  await run(cargoOf(rust), ["build", "--quiet", "--release", "--locked", "-p", "strut-motion-cli"], {
    env: rust,
    cwd: RUST,
  });
  const name = `strut-${currentVersion()}-${target}`;
  const folder = mkdtempSync(join(tmpdir(), "strut-release-"));
  mkdirSync(join(folder, name));
  const program = process.platform === "win32" ? "strut.exe" : "strut";
  cpSync(join(process.env.CARGO_TARGET_DIR ?? join(RUST, "target"), "release", program), join(folder, name, program));
  for (const file of ["LICENSE", "LICENSE-MIT", "LICENSE-APACHE", "README.md", "CHANGELOG.md"])
    cpSync(join(root, file), join(folder, name, file));
  await run("tar", ["-czf", join(out, `${name}.tar.gz`), "-C", folder, name]);
  rmSync(folder, { recursive: true });
}

/** Returns the environment in which wheels are built; Python is required here. */
async function maturin() {
  const python = await setupPython("Python package");
  if (!python) throw new Sentence("A release needs Python 3.11 or newer with its module venv.");
  const environment = join(RUST, "target", "python", "release");
  const requirements = join(root, "scripts", "release", "requirements.txt");
  await setupEnvironment(python, { environment, requirements, label: "Installing what wheels are built with" });
  const rust = await setupRust();
  return {
    program: programIn(environment, "maturin"),
    env: { ...rust, PATH: `${join(environment, "bin")}:${rust.PATH}` },
  };
}

/**
 * Options of maturin by system. On Linux zig links against the oldest C library that numpy's own wheels support; on
 * macOS one wheel serves both processor types.
 */
const WHEEL_OPTIONS = {
  linux: ["--zig", "--compatibility", "manylinux2014"],
  darwin: ["--target", "universal2-apple-darwin"],
  win32: [],
};

/** Writes the wheel for this system, for all versions of Python from 3.11 on. */
async function wheel(out) {
  const { program, env } = await maturin();
  const options = WHEEL_OPTIONS[process.platform];
  await run(program, ["build", "--quiet", "--locked", ...options, "--out", out], { env, cwd: PYTHON });
}

/** Writes the source distribution. */
async function sdist(out) {
  const { program, env } = await maturin();
  await run(program, ["sdist", "--out", out], { env, cwd: PYTHON });
}

/** Writes the npm package, fully optimised. */
async function npm(out) {
  await buildWasm({ mode: "full" });
  await writePackage({ mode: "full" });
  await run("npm", ["pack", "--silent", join(root, "dist", "package"), "--pack-destination", out]);
}

/** Writes the crates in the form for crates.io. The test of the release compiles them, and so does publishing. */
async function crates(out) {
  const rust = await setupRust();
  const packages = join(process.env.CARGO_TARGET_DIR ?? join(RUST, "target"), "package");
  const selected = CRATES.flatMap((name) => ["-p", name]);
  await run(cargoOf(rust), ["package", "--quiet", "--locked", "--no-verify", ...selected], { env: rust, cwd: RUST });
  for (const name of CRATES)
    cpSync(join(packages, `${name}-${currentVersion()}.crate`), join(out, `${name}-${currentVersion()}.crate`));
}

/** Publishes the crates, each after those that it needs. The token comes from the environment. */
export async function publishCrates() {
  const rust = await setupRust();
  const selected = CRATES.flatMap((name) => ["-p", name]);
  await run(cargoOf(rust), ["publish", "--locked", ...selected], { env: rust, cwd: RUST });
}

/** Returns the path of the artefact in `folder` whose name matches, or undefined. */
export function findArtefact(folder, pattern) {
  const name = existsSync(folder) ? readdirSync(folder).find((name) => pattern.test(name)) : undefined;
  return name && join(folder, name);
}
