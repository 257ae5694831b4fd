// The examples of the documentation: each is run unchanged.
import { execFileSync, spawnSync } from "node:child_process";
import {
  cpSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import { buildPrograms, COMMAND } from "../programs";
import { root } from "../recordings";

const EXAMPLES = join(root, "examples");
/** Environment in which `scripts/python.mjs` installed the Python package. */
const PYTHON = join(root, "rust", "target", "python", "venv", "bin", "python");
const needsPython = test.skipIf(!existsSync(PYTHON) && process.env.STRUT_PYTHON !== "required");

let folder: string;
const path = () => `${dirname(COMMAND)}:${process.env.PATH}`;
const run = (program: string, ...args: string[]) =>
  execFileSync(program, args, { cwd: folder, encoding: "utf8", env: { ...process.env, PATH: path() } });
const script = (name: string) => run("sh", join(EXAMPLES, "cli", name));
const frames = (name: string) => Number(/^Frames: (\d+)/m.exec(readFileSync(join(folder, name), "utf8"))![1]);

beforeAll(() => {
  buildPrograms();
  folder = mkdtempSync(join(tmpdir(), "strut-examples-"));
  mkdirSync(join(folder, "node_modules"));
  symlinkSync(join(root, "dist", "package"), join(folder, "node_modules", "strut-motion"));
  expect(script("first_steps.sh")).toContain("walk-proud.bvh");
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

test("a database and clips are written, and one is styled", () => {
  // The proud walk is slower.
  expect(frames("walk-proud.bvh")).toBeGreaterThan(frames("clips/walk_neutral_001.bvh"));
});

test("walks are synthesised from a model that was trained", () => {
  script("walk.sh");
  expect(frames("walk.bvh")).toBeGreaterThan(60);
});

test("a motion goes through keys", () => {
  script("key_style.sh");
  expect(frames("keyed.bvh")).toBeGreaterThan(20);
});

test("a database gets another style, and one is built of clips", () => {
  expect(script("own_styles.sh")).toContain("tired");
  for (const name of ["session1.strutdb", "walk-old.bvh"]) expect(existsSync(join(folder, name)), name).toBe(true);
});

test("many files are styled, in mixtures, by parts and along a path", () => {
  script("many_files.sh");
  for (const name of [
    "old/walk_neutral_001.bvh",
    "old/run_neutral_001.bvh",
    "mixed.bvh",
    "parts.bvh",
    "old.jsonl",
    "along.bvh",
  ])
    expect(existsSync(join(folder, name)), name).toBe(true);
});

test("a batch has two variants", () => {
  script("batch.sh");
  for (const variant of ["old", "mixed"])
    expect(existsSync(join(folder, "out", variant, "walk_neutral_001.bvh")), variant).toBe(true);
});

test("the package styles a walk in Node", () => {
  cpSync(join(EXAMPLES, "js", "first_style.mjs"), join(folder, "first_style.mjs"));
  rmSync(join(folder, "walk-proud.bvh"));
  run(process.execPath, "first_style.mjs");
  expect(frames("walk-proud.bvh")).toBeGreaterThan(60);
});

test("the code of the package's README styles, and builds a database", () => {
  cpSync(join(EXAMPLES, "js", "styling.mjs"), join(folder, "styling.mjs"));
  const [text, frame, share, styles, bytes, read] = JSON.parse(run(process.execPath, "styling.mjs")) as unknown[];
  expect([text, frame, share, styles]).toEqual(["HIERARCHY", 0, 1, ["neutral", "old", "tired"]]);
  expect(read).toEqual([[], null]);
  expect(bytes).toBeGreaterThan(100_000);
});

test("all examples in JavaScript have the types of the package", () => {
  const types = join(folder, "types");
  cpSync(join(EXAMPLES, "js"), types, { recursive: true });
  mkdirSync(join(types, "node_modules", "@types"), { recursive: true });
  symlinkSync(join(root, "dist", "package"), join(types, "node_modules", "strut-motion"));
  for (const name of ["three", "@types/three", "@types/node"])
    symlinkSync(join(root, "node_modules", name), join(types, "node_modules", name));
  const compilerOptions = {
    strict: true,
    noEmit: true,
    // The declarations of three.js may have errors.
    skipLibCheck: true,
    checkJs: true,
    target: "es2022",
    module: "esnext",
    moduleResolution: "bundler",
    // Each file is independent.
    moduleDetection: "force",
    lib: ["es2023", "dom"],
    types: ["node"],
  };
  const files = readdirSync(join(EXAMPLES, "js"));
  writeFileSync(join(types, "tsconfig.json"), JSON.stringify({ compilerOptions, files }));
  const tsc = join(root, "node_modules", "typescript", "bin", "tsc");
  expect(spawnSync(process.execPath, [tsc, "-p", types], { cwd: types, encoding: "utf8" }).stdout).toBe("");
});

needsPython("the package styles a walk in Python", () => {
  rmSync(join(folder, "walk-proud.bvh"), { force: true });
  expect(run(PYTHON, join(EXAMPLES, "python", "first_style.py"))).toMatch(/^\(\d+, 87\) \d/);
  expect(frames("walk-proud.bvh")).toBeGreaterThan(frames("clips/walk_neutral_001.bvh"));
});

needsPython("a database is read as the page on file formats says", () => {
  run(COMMAND, "inspect", "demo.strutdb", "--json", "demo.json");
  const { frames: count } = JSON.parse(readFileSync(join(folder, "demo.json"), "utf8")) as { frames: number };
  const printed = run(PYTHON, join(EXAMPLES, "python", "strutdb_file.py")).trim();
  expect(printed).toBe(`${count} frames at 60.0 Hz, joints within 0.00 mm`);
});

needsPython("options of Python, and a batch on two processes", () => {
  expect(run(PYTHON, join(EXAMPLES, "python", "styles.py"))).toMatch(/^\(\d+, 87\) \d/);
  const done = run(PYTHON, join(EXAMPLES, "python", "batch.py"))
    .trim()
    .split("\n")
    .sort();
  expect(done).toEqual(["half/run_neutral_001.bvh done", "half/walk_neutral_001.bvh done"]);
});
