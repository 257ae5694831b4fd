// Line coverage of the engine by the inputs of fuzzing: `npm run fuzz -- --lines`. The targets are built again with
// rustc's coverage instrumentation (https://doc.rust-lang.org/rustc/instrument-coverage.html), and run their existing
// inputs.
import { existsSync, mkdirSync, rmSync } from "node:fs";
import { join, relative, sep } from "node:path";
import { findProgram, output, root, run, Sentence } from "./steps.mjs";

const RUST = join(root, "rust");
/** Crates whose lines are counted. */
const CRATES = ["strut-core", "strut-formats"].map((name) => join(RUST, name, "src") + sep);

/** Returns paths of LLVM's tools for the compiler, and installs them; rustup's minimal profile omits them. */
async function setupLlvmTools(env, host) {
  const sysroot = (await output(env.RUSTC ?? "rustc", ["--print", "sysroot"], { env })) ?? "";
  const tool = (name) => join(sysroot, "lib", "rustlib", host, "bin", name);
  const tools = { profdata: tool("llvm-profdata"), cov: tool("llvm-cov") };
  if (Object.values(tools).every((path) => existsSync(path))) return tools;
  if (!findProgram("rustup"))
    throw new Sentence("Counting lines needs the LLVM tools of the compiler. Install rustup, then run this again.");
  await run("rustup", ["component", "add", "llvm-tools"]);
  return tools;
}

/** Builds the instrumented targets. Returns functions that measure the coverage by the inputs in some folders. */
export async function buildCounted(env, { host, folder, cargoArgs }) {
  const tools = await setupLlvmTools(env, host);
  const target = join(folder, "lines");
  await run(env.CARGO ?? "cargo", ["build", "--quiet", ...cargoArgs, "--target", host, "--target-dir", target], {
    cwd: RUST,
    env: { ...env, CARGO_ENCODED_RUSTFLAGS: "-Cinstrument-coverage" },
  });
  const program = join(target, host, "fuzz", "strut-fuzz");
  const profiles = join(target, "profiles");
  rmSync(profiles, { recursive: true, force: true });
  mkdirSync(profiles, { recursive: true });
  const profileOf = (name) => join(profiles, `${name}.profdata`);

  /** Returns covered lines and all lines of each source file of a profile with a covered line. */
  async function linesOf(profile) {
    const report = await output(tools.cov, ["export", "-summary-only", `-instr-profile=${profile}`, program]);
    if (report === undefined) throw new Sentence(`${tools.cov} could not read ${profile}.`);
    const files = JSON.parse(report).data[0].files.map(({ filename, summary }) => ({
      path: filename,
      ...summary.lines,
    }));
    return files
      .filter(({ path, covered }) => covered > 0 && CRATES.some((crate) => path.startsWith(crate)))
      .map(({ path, count, covered }) => ({ path: relative(RUST, path), count, covered }));
  }

  return {
    /** Returns the lines that the inputs of a target cover; see {@link linesOf}. */
    async ofTarget(name, inputs) {
      const raw = join(profiles, `${name}.profraw`);
      const read = { env: { STRUT_FUZZ_TARGET: name, LLVM_PROFILE_FILE: raw } };
      if ((await output(program, ["-runs=0", ...inputs], read)) === undefined)
        throw new Sentence(`${name} could not read its inputs.`);
      await run(tools.profdata, ["merge", "-sparse", raw, "-o", profileOf(name)]);
      rmSync(raw);
      return linesOf(profileOf(name));
    },
    /** Returns the lines that the inputs of several targets cover together. */
    async ofAll(names) {
      const all = profileOf("all");
      await run(tools.profdata, ["merge", "-sparse", ...names.map(profileOf), "-o", all]);
      return linesOf(all);
    },
  };
}
