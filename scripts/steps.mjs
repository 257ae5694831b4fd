// Runs the steps of a command, and prints the label and the duration of each.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** Root of the repository. */
export const root = dirname(dirname(fileURLToPath(import.meta.url)));

/** An error whose message is sufficient for users; printed without a stack. */
export class Sentence extends Error {}

const seconds = (since) => `${((performance.now() - since) / 1000).toFixed(1)} s`;

/** Labels of the steps that run now. */
const running = new Set();

/**
 * Prints a step's label, runs it and prints its duration, with a string that it may return, and with its label if
 * another step runs at the same time.
 */
export async function step(label, work) {
  const started = performance.now();
  console.log(`▸ ${label}`);
  running.add(label);
  let remark;
  try {
    remark = await work();
  } finally {
    running.delete(label);
  }
  const which = running.size > 0 ? `${label}: ` : "";
  console.log(`  ${which}done in ${seconds(started)}${remark ? `: ${remark}` : ""}`);
}

/** Runs a program with its output shown. Rejects with a {@link Sentence} if it fails. */
export function run(program, args, { env = {}, cwd = root } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(program, args, { cwd, stdio: "inherit", env: { ...process.env, ...env } });
    child.on("error", (error) => reject(new Sentence(`${program} could not be started: ${error.message}`)));
    child.on("close", (code, signal) =>
      code === 0 ? resolve() : reject(new Sentence(`${program} ${args.join(" ")} ended with ${signal ?? code}.`)),
    );
  });
}

/** Runs a program quietly. Returns its standard output, trimmed, or undefined if it fails or does not exist. */
export function output(program, args, { env = {}, cwd = root } = {}) {
  return new Promise((resolve) => {
    const child = spawn(program, args, { cwd, stdio: ["ignore", "pipe", "ignore"], env: { ...process.env, ...env } });
    let text = "";
    child.stdout.on("data", (chunk) => {
      text += chunk;
    });
    child.on("error", () => resolve(undefined));
    child.on("close", (code) => resolve(code === 0 ? text.trim() : undefined));
  });
}

/** Returns the path of a program on PATH or in the given folders, or undefined. */
export function findProgram(name, folders = []) {
  const places = [...folders, ...(process.env.PATH ?? "").split(process.platform === "win32" ? ";" : ":")];
  const file = process.platform === "win32" ? `${name}.exe` : name;
  return places.map((folder) => join(folder, file)).find((path) => existsSync(path));
}

/** Runs a command's body, prints a {@link Sentence} without a stack and sets the exit code. */
export async function main(body) {
  const started = performance.now();
  try {
    await body();
    console.log(`All done in ${seconds(started)}.`);
  } catch (error) {
    console.error(error instanceof Sentence ? `error: ${error.message}` : error);
    process.exitCode = 1;
  }
}
