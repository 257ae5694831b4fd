/**
 * The packages that visitors load style a file as the command does, byte for byte: the engine's, the Compare view's
 * with the pretrained methods, and the lessons'.
 */
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { buildPrograms, COMMAND } from "../programs";

/** The part of either package that is used here. */
interface Glue {
  initSync(source: { module: BufferSource }): unknown;
  Database: { fromBytes(bytes: Uint8Array): { styles(): string[] } };
  Input: { fromBvh(database: object, bytes: Uint8Array): { frames(): number } };
  Stylizer: new (
    database: object,
  ) => {
    configure(...options: (number | boolean | string)[]): void;
    setStyles(weights: Float32Array): void;
  };
  ClipJob: new (stylizer: object, input: object) => { run(frames: number): number; toBvh(input: object): string };
}

const PACKAGES = {
  engine: { folder: "web/engine/pkg", name: "strut_wasm", methods: ["mar", "lar", "nn", "knn"] },
  embed: { folder: "web/engine/embed/pkg", name: "strut_wasm", methods: ["mar", "lar", "nn", "knn"] },
  compare: { folder: "web/engine/compare/pkg", name: "strut_compare", methods: ["mar", "gar", "lti", "gp"] },
  learn: { folder: "web/engine/learn/pkg", name: "strut_learn", methods: ["mar", "knn"] },
};

const CLIP = "demo/walk_neutral_001.bvh";
const STYLE = "old";

let folder: string;
beforeAll(() => {
  buildPrograms();
  folder = mkdtempSync(join(tmpdir(), "strut-shipped-"));
  execFileSync(COMMAND, ["demo-db", "-o", "demo.strutdb", "--bvh", "demo"], { cwd: folder, stdio: "pipe" });
}, 900_000);
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

/** Returns the styled file as the command writes it. */
function byCommand(method: string): string {
  const args = ["stylize", "--db", "demo.strutdb", "--input", CLIP, "--style", STYLE, "--method", method];
  execFileSync(COMMAND, [...args, "-o", "out.bvh"], { cwd: folder, stdio: "pipe" });
  return readFileSync(join(folder, "out.bvh"), "utf8");
}

/** Returns the styled file as a package writes it, with the mixture's width `delta`. */
async function byPackage({ folder: pkg, name }: { folder: string; name: string }, method: string, delta = 0.35) {
  const at = new URL(`../../${pkg}/`, import.meta.url);
  const glue: Glue = await import(/* @vite-ignore */ new URL(`${name}.js`, at).href);
  glue.initSync({ module: readFileSync(new URL(`${name}_bg.wasm`, at)) });
  const database = glue.Database.fromBytes(readFileSync(join(folder, "demo.strutdb")));
  const input = glue.Input.fromBvh(database, readFileSync(join(folder, CLIP)));
  const stylizer = new glue.Stylizer(database);
  const [k, lambda, rho, kappa, tempo] = [40, 0.1, 0.7, 3, 0.5];
  stylizer.configure(k, lambda, rho, kappa, delta, tempo, true, true, true, method);
  stylizer.setStyles(Float32Array.from(database.styles(), (style) => (style === STYLE ? 1 : 0)));
  const job = new glue.ClipJob(stylizer, input);
  expect(job.run(input.frames())).toBe(input.frames());
  return job.toBvh(input);
}

describe.each(Object.entries(PACKAGES))("the package of the %s", (_, pkg) => {
  test.each(pkg.methods)("styles by %s as the command does", { timeout: 300_000 }, async (method) => {
    // Not `toBe`, which would print megabytes.
    expect((await byPackage(pkg, method)) === byCommand(method)).toBe(true);
  });

  test("gives another file with another option", { timeout: 300_000 }, async () => {
    expect((await byPackage(pkg, "mar", 0.6)) === byCommand("mar")).toBe(false);
  });
});
