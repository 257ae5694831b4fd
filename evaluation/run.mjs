// npm run evaluate [-- ID …] [--fresh]: runs the experiments and writes docs/evaluation.md with its figures. The ID
// drive writes docs/driving.md.
//
// Results are kept in evaluation/results. A finished experiment is not repeated unless it is named or --fresh is given;
// an interrupted one is resumed. Figures of real motion are never committed: curves are those of the built-in motions.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { cpus } from "node:os";
import { join } from "node:path";
import { setupRust } from "../scripts/setup.mjs";
import { main, root, run, Sentence, step } from "../scripts/steps.mjs";
import { evaluateDriving } from "./drive.mjs";
import { experiments } from "./experiments.mjs";
import { errorBars, jointCurve, timeWarp } from "./figures.mjs";

const results = join(root, "evaluation", "results");
const pictures = join(root, "docs", "evaluation");
const demo = join(results, "demo-motions");
const file = (id, kind) => join(results, `${id}.${kind}`);

/** ID of the driving experiments. */
const DRIVE = "drive";

/** Returns the folder of real motion capture. */
function mocap() {
  const folder = process.env.STRUT_MOCAP ?? join(root, "..", "shared", "data");
  if (!existsSync(folder)) throw new Sentence(`there is no motion capture in ${folder}; set STRUT_MOCAP to its folder`);
  return folder;
}

const words = (args, places) =>
  args
    .split(" ")
    .map((word) => Object.entries(places).reduce((w, [name, path]) => w.replaceAll(`$${name}`, path), word));

/** Returns the arguments of an experiment's command. */
const commandOf = ({ id, args, curves }, places) => [
  "evaluate",
  ...words(args, places),
  ...["--json", file(id, "json")],
  ...(curves ? ["--curves", file(id, "curves.json")] : []),
];

/** Returns whether the results of exactly this command exist. */
async function isDone(experiment, places) {
  if (!["md", "json"].every((kind) => existsSync(file(experiment.id, kind)))) return false;
  return (await json(file(experiment.id, "json"))).command === ["strut", ...commandOf(experiment, places)].join(" ");
}

/** Runs one experiment, and stores its table and results. */
async function measure(strut, experiment, places) {
  const { status, stdout } = spawnSync(strut, commandOf(experiment, places), {
    stdio: ["ignore", "pipe", "inherit"],
    encoding: "utf8",
  });
  if (status !== 0) throw new Sentence(`${experiment.title} could not be measured.`);
  await writeFile(file(experiment.id, "md"), stdout);
}

const json = async (path) => JSON.parse(await readFile(path, "utf8"));

/** Returns one experiment as Markdown. */
async function section({ id, title, question, args, curves, findings = "" }) {
  const table = await readFile(file(id, "md"), "utf8");
  const command = `strut evaluate ${args}`.replaceAll("$MOCAP", "../shared/data").replaceAll("$DEMO", "demo");
  const figures = curves
    ? [
        "![A knee over time, by method](evaluation/joint-curve.svg)",
        "![Output time against input time, by method](evaluation/time-warp.svg)",
      ].join("\n\n")
    : "";
  return [`## ${title}`, question, `\`\`\`sh\n${command}\n\`\`\``, table.trimEnd(), findings, figures]
    .filter(Boolean)
    .join("\n\n");
}

const INTRODUCTION = `# Evaluation

Written by \`npm run evaluate\`; every table comes from the command above it.

| Term | Meaning |
| --- | --- |
| pose error | mean distance of 20 joints, with hips and heading aligned, over whole gait cycles of the held-out take, before the footplant |
| timing error | mean difference of the time since the beginning of the cycle |
| velocity error | mean difference of the joint velocities per second of input |
| input unchanged | errors of the input without styling |
| floor | errors of other real takes of the target style |
| skate | mean speed of the point about which a foot turns, while the finished motion's own contacts show it planted |
| nn, knn | the nearest neighbour; the mean of the K nearest |
| lar, mar | one local autoregression; the mixture of autoregressive models |
| gar, lti, gp | methods trained on all frames: an autoregression; a linear time-invariant system (Hsu et al. 2005); a Gaussian process (Ikemoto et al. 2009) |
| lti-dof | one lti for each degree of freedom |`;

await main(async () => {
  const args = process.argv.slice(2);
  const fresh = args.includes("--fresh");
  const wanted = args.filter((a) => a !== "--fresh");
  const ids = [...experiments.map((e) => e.id), DRIVE];
  const unknown = wanted.find((id) => !ids.includes(id));
  if (unknown) throw new Sentence(`there is no experiment '${unknown}'; ${ids.join(", ")} are`);
  const places = { MOCAP: mocap(), DEMO: demo };
  const rust = await setupRust();
  await step("Building the command", () =>
    run(rust.CARGO ?? "cargo", ["build", "--release", "--quiet", "-p", "strut-motion-cli"], {
      env: rust,
      cwd: join(root, "rust"),
    }),
  );
  const strut = join(root, "rust", "target", "release", "strut");
  await mkdir(results, { recursive: true });
  await mkdir(pictures, { recursive: true });
  await run(strut, ["demo-db", "--page", "-o", file("demo-motions", "strutdb"), "--bvh", demo]);
  const driving = wanted.includes(DRIVE) || (wanted.length === 0 && fresh);
  if (driving)
    await step("Driving and docs/driving.md", () => evaluateDriving(strut, places.MOCAP, results, join(root, "docs")));
  if (wanted.length > 0 && wanted.every((id) => id === DRIVE)) return;
  for (const experiment of experiments) {
    const asked = wanted.includes(experiment.id) || (wanted.length === 0 && fresh);
    if (asked || (wanted.length === 0 && !(await isDone(experiment, places))))
      await step(experiment.title, () => measure(strut, experiment, places));
  }
  const done = experiments.filter((e) => existsSync(file(e.id, "md")));
  await step("Figures and docs/evaluation.md", async () => {
    const sets = [];
    for (const e of done) if (e.set) sets.push({ set: e.set, results: (await json(file(e.id, "json"))).results });
    if (sets.length > 0) await writeFile(join(pictures, "error-bars.svg"), await errorBars(sets));
    for (const e of done.filter((e) => e.curves)) {
      const [trial] = await json(file(e.id, "curves.json"));
      await writeFile(join(pictures, "joint-curve.svg"), await jointCurve(trial));
      await writeFile(join(pictures, "time-warp.svg"), await timeWarp(trial));
    }
    const machine = `Measured on ${cpus().length} × ${cpus()[0]?.model.trim() ?? "unknown processor"}; times are CPU times of this machine.`;
    const bars = "![Errors by method and data set](evaluation/error-bars.svg)";
    const sections = await Promise.all(done.map(section));
    await writeFile(
      join(root, "docs", "evaluation.md"),
      `${[INTRODUCTION, machine, bars, ...sections].join("\n\n")}\n`,
    );
  });
});
