/**
 * Bundlers with separate packages, which are too large for the project's. Each builds in a copy of its folder, from its
 * own lockfile and the packed tarball. `npm run consumers` runs them.
 */
import { spawn, spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { isDeepStrictEqual } from "node:util";
import type { Browser } from "playwright-core";
import { root } from "../recordings";
import { type Consumer, styledByNode } from "./consumer";
import { copyData, expected, html, loadedKb, program, type Said, summary, visitPage } from "./page";
import { serveFolder } from "./server";

/** A run in a folder in which everything is installed. It returns a remark. */
interface Run {
  name: string;
  /** The package whose version is reported. */
  version: string;
  run: (project: Project) => Promise<string>;
}

/** Runs with one set of packages. */
export interface Bundler {
  /** Folder below `tests/package/`, with manifest and lockfile. */
  folder: string;
  runs: readonly Run[];
}

/** A user's project in a separate folder. */
export interface Project {
  folder: string;
  consumer: Consumer;
  browser: Browser;
}

/** A user's environment, without the variables that npm and Vite set for their child processes. */
const ENVIRONMENT = {
  ...process.env,
  NODE_ENV: undefined,
  npm_config_loglevel: "error",
  NEXT_TELEMETRY_DISABLED: "1",
};

/**
 * Runs a program in a project. @throws Error with the beginning of its output, also if it warned about the package's
 * code
 */
function run({ folder }: Pick<Project, "folder">, program: string, ...args: string[]): void {
  const { status, stdout, stderr } = spawnSync(program, args, { cwd: folder, env: ENVIRONMENT, encoding: "utf8" });
  const printed = `${stdout}${stderr}`;
  if (status !== 0 || printed.includes("Critical dependency"))
    throw new Error(`${[program, ...args].join(" ")} failed:\n${printed.slice(0, 2000)}`);
}

/** @throws Error if the output differs from the command's */
function check(said: Said, thread: string, { consumer }: Project): void {
  const [got, want] = [summary(said, consumer), expected(thread)];
  if (!isDeepStrictEqual(got, want)) throw new Error(`got ${JSON.stringify(got)}, expected ${JSON.stringify(want)}`);
}

/** Everything that needs three.js, except three-vrm, which few users have. */
const CHARACTERS = `import "strut-motion/element";
export { loadCharacter } from "strut-motion/three";
`;

/** Opens a page and returns what it loaded. */
async function report(project: Project, url: string): Promise<string> {
  const { said, urls } = await visitPage(project.browser, url);
  check(said, "worker", project);
  return `${said.frames} frames equal, ${(await loadedKb(urls)).toFixed(0)} kB loaded`;
}

/**
 * Runs a bundler that writes a page to `dist/`.
 * @param page the page of the bundle, for bundlers that write only scripts
 */
const staticSite = (page?: string) => async (project: Project) => {
  const dist = join(project.folder, "dist");
  writeFileSync(join(project.folder, "main.js"), program());
  writeFileSync(join(project.folder, "index.html"), html("./main.js"));
  run(project, "npm", "run", "build");
  if (page !== undefined) writeFileSync(join(dist, "index.html"), page);
  copyData(project.consumer, dist);
  const server = await serveFolder(dist);
  const loaded = await report(project, server.url).finally(server.close);
  writeFileSync(join(project.folder, "main.js"), CHARACTERS);
  run(project, "npm", "run", "build");
  return loaded;
};

/** Starts Next.js's own server of a build, and waits until it listens. */
async function startNext(folder: string): Promise<{ url: string; close: () => void }> {
  const next = join(folder, "node_modules", "next", "dist", "bin", "next");
  const server = spawn(process.execPath, [next, "start", "--port", "0"], {
    cwd: folder,
    env: ENVIRONMENT,
    detached: true,
  });
  // It starts child processes.
  const close = () => process.kill(-server.pid!);
  const url = await new Promise<string>((resolve, reject) => {
    let printed = "";
    const read = (chunk: Buffer) => {
      printed += chunk;
      const address = /http:\/\/localhost:\d+/.exec(printed);
      if (address && printed.includes("Ready")) resolve(address[0]);
    };
    server.stdout.on("data", read);
    server.stderr.on("data", read);
    server.on("close", () => reject(new Error(`next start ended:\n${printed}`)));
  });
  return { url, close };
}

/** Returns the output of a server component in its page. */
async function renderedBy(url: string): Promise<Said> {
  const text = await (await fetch(url)).text();
  const match = /<pre data-thread="(\w+)" data-frames="(\d+)">([^<]*)<\/pre>/.exec(text);
  if (!match) throw new Error(`${url} rendered nothing: ${text.slice(0, 1000)}`);
  return { thread: match[1]!, frames: Number(match[2]), bvh: match[3]! };
}

/**
 * Client page and server components. Built-in data must be next to the package's code, which is then not bundled. The
 * build is moved before the test, because otherwise the folder in which the package was installed would also work.
 */
const next =
  (...flags: string[]) =>
  async (project: Project) => {
    const { consumer, folder } = project;
    copyData(consumer, join(folder, "public"));
    const visited = async (place: string, pages: (url: string) => Promise<string>) => {
      run(project, "npm", "run", "build", "--", ...flags);
      renameSync(folder, place);
      const server = await startNext(place);
      try {
        return await pages(server.url);
      } finally {
        server.close();
        renameSync(place, folder);
      }
    };
    const config = join(folder, "next.config.mjs");
    const external = readFileSync(config);
    rmSync(config);
    const loaded = await visited(folder, async (url) => {
      check(await renderedBy(`${url}/server`), "node", project);
      return report(project, url);
    });
    writeFileSync(config, external);
    await visited(`${folder}-moved`, async (url) => {
      check(await renderedBy(`${url}/server`), "node", project);
      const { bvh, ...said } = await renderedBy(`${url}/built_in`);
      const same = bvh === styledByNode(consumer);
      if (!same) throw new Error(`built-in data: ${JSON.stringify(said)}, and other frames than in Node`);
      return "";
    });
    return loaded;
  };

/** A linter of packages, for the tarball. */
const linter =
  (program: string, ...options: string[]) =>
  async (project: Project) => {
    run(project, "npx", program, project.consumer.tarball, ...options);
    return "no remark";
  };

// Fetched files have no types.
const TYPES_ONLY = ["--profile", "esm-only", "--exclude-entrypoints", "./assets/*"];

/** All bundlers. */
export const BUNDLERS: readonly Bundler[] = [
  { folder: "webpack", runs: [{ name: "webpack", version: "webpack", run: staticSite(html("main.js")) }] },
  { folder: "rollup", runs: [{ name: "Rollup", version: "rollup", run: staticSite(html("main.js")) }] },
  { folder: "parcel", runs: [{ name: "Parcel", version: "parcel", run: staticSite() }] },
  {
    folder: "next",
    runs: [
      { name: "Next with Turbopack", version: "next", run: next() },
      { name: "Next with webpack", version: "next", run: next("--webpack") },
    ],
  },
  {
    folder: "lint",
    runs: [
      { name: "publint", version: "publint", run: linter("publint", "--strict") },
      { name: "attw", version: "@arethetypeswrong/cli", run: linter("attw", ...TYPES_ONLY) },
    ],
  },
];

/** Returns the version of three.js that this project uses. */
function threeVersion(): string {
  return JSON.parse(readFileSync(join(root, "node_modules", "three", "package.json"), "utf8")).version;
}

/**
 * Installs a bundler and the tarball in a copy of its folder, and does all its runs.
 * @param print receives a line for each run
 * @returns whether all succeeded
 */
export async function tryBundler(
  bundler: Bundler,
  consumer: Consumer,
  browser: Browser,
  print: (line: string) => void,
): Promise<boolean> {
  const folder = mkdtempSync(join(tmpdir(), `strut-${bundler.folder}-`));
  try {
    cpSync(join(import.meta.dirname, bundler.folder), folder, { recursive: true });
    // Not `npm ci`: it requires the binaries of all platforms in a lockfile, which not every registry has.
    const quick = ["--no-save", "--prefer-offline", "--no-audit", "--no-fund"];
    run({ folder }, "npm", "install", ...quick, consumer.tarball, `three@${threeVersion()}`);
    for (const { name, version, run } of bundler.runs) {
      const manifest = JSON.parse(readFileSync(join(folder, "node_modules", version, "package.json"), "utf8"));
      print(`${name} ${manifest.version}: ok, ${await run({ folder, consumer, browser })}`);
    }
    return true;
  } catch (thrown) {
    print(`${bundler.folder}: FAILED, ${(thrown as Error).message}`);
    return false;
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
