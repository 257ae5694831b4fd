// Checks GitHub's workflows and CITATION.cff: their schemas, and the security of workflows (zizmor).
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { programIn, setupEnvironment, setupPython } from "./python_environment.mjs";
import { root, run } from "./steps.mjs";

const WORKFLOWS = join(".github", "workflows");
const ENVIRONMENT = join(root, "rust", "target", "python", "lint");

/** Checks the files; without Python this is skipped. */
export async function checkWorkflows() {
  const python = await setupPython("Lints of workflows");
  if (!python) return;
  const requirements = join(root, "scripts", "lint", "requirements.txt");
  await setupEnvironment(python, {
    environment: ENVIRONMENT,
    requirements,
    label: "Installing what workflows are checked with",
  });
  const files = readdirSync(join(root, WORKFLOWS)).map((name) => join(WORKFLOWS, name));
  const schema = (name, ...files) =>
    run(programIn(ENVIRONMENT, "check-jsonschema"), ["-qq", "--builtin-schema", name, ...files]);
  await schema("vendor.github-workflows", ...files);
  await schema("vendor.citation-file-format", "CITATION.cff");
  await run(programIn(ENVIRONMENT, "zizmor"), ["--offline", "--quiet", ...files]);
}
