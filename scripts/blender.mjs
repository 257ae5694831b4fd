// npm run blender [-- 4.5 5.0]: builds the Blender extension as an installable file, dist/blender/, and runs its tests
// in bpy, Blender as a Python module. Each version of bpy is 373 MB, so this is not part of npm test.
import { existsSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { writeRigs } from "./blender/rigs.mjs";
import { buildPythonWheel, WHEELS } from "./python.mjs";
import { programIn, setupEnvironment, setupPython } from "./python_environment.mjs";
import { setupRust } from "./setup.mjs";
import { main, output, root, run, Sentence, step } from "./steps.mjs";

const EXTENSION = join(root, "blender");
const TARGET = join(root, "rust", "target", "blender");
const FILES = join(TARGET, "files");
const VERSIONS = ["4.5", "5.0"];

/** Writes the files that the tests need: databases and clips of the command, rigs. */
async function writeFiles(env) {
  rmSync(FILES, { recursive: true, force: true });
  mkdirSync(FILES, { recursive: true });
  await writeRigs(join(FILES, "rigs"));
  const written = ["demo-db", "-o", join(FILES, "demo.strutdb"), "--bvh", join(FILES, "clips")];
  const cargo = ["run", "--quiet", "--release", "-p", "strut-motion-cli", "--", ...written];
  await run(env.CARGO ?? "cargo", cargo, { env, cwd: join(root, "rust") });
}

async function testIn(version, python, wheel) {
  const environment = join(TARGET, version);
  await setupEnvironment(python, {
    environment,
    requirements: join(EXTENSION, `requirements-${version}.txt`),
    label: `Installing bpy ${version}`,
  });
  await step(`Tests in Blender ${version}`, async () => {
    const program = programIn(environment, "python");
    const pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--force-reinstall"];
    await run(program, [...pip, wheel]);
    const env = { STRUT_BLENDER_FILES: FILES, PYTHONDONTWRITEBYTECODE: "1" };
    await run(program, ["-m", "pytest", "-q", "-s", "-p", "no:cacheprovider", "tests"], { env, cwd: EXTENSION });
  });
}

await main(async () => {
  const asked = process.argv.slice(2);
  const unknown = asked.find((version) => !VERSIONS.includes(version));
  if (unknown) throw new Sentence(`Unknown version of bpy: ${unknown}. Known: ${VERSIONS.join(", ")}.`);
  const python = await setupPython("Blender extension");
  if (!python) throw new Sentence("The Blender extension needs Python 3.11 with its module venv.");
  // bpy's wheels of these versions require this Python.
  if (!(await output(python, ["--version"]))?.startsWith("Python 3.11."))
    throw new Sentence("bpy 4.5 and 5.0 need Python 3.11; put it first on PATH.");
  const env = await setupRust();
  await buildPythonWheel(python, env);
  const [wheel] = readdirSync(WHEELS).map((name) => join(WHEELS, name));
  const folder = join(root, "dist", "blender");
  await step("Extension", async () => {
    await run(python, [join(EXTENSION, "package.py"), "--wheels", WHEELS, "--out", folder]);
    return readdirSync(folder).join(", ");
  });
  if (!existsSync(join(FILES, "clips"))) await step("Clips, styles and rigs", () => writeFiles(env));
  for (const version of asked.length > 0 ? asked : VERSIONS) await testIn(version, python, wheel);
});
