/** The page trains the same key-style models as the command, byte for byte, and makes the same motions with them. */
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { BuildClient } from "../../web/client/build/client";
import { KeyStyleModel } from "../../web/client/models/key_style";
import { InlineBuildWorker } from "../inline_build_worker";
import { buildPrograms, COMMAND } from "../programs";
import { recordings } from "../recordings";

const AXES = ["foot_separation", "foot_height_difference", "hand_l.y - hips.y"];
let folder: string;
beforeAll(() => {
  buildPrograms();
  folder = mkdtempSync(join(tmpdir(), "strut-key-style-"));
  const run = (...args: string[]) => execFileSync(COMMAND, args, { cwd: folder, stdio: "pipe" });
  run("demo-db", "-o", "demo.strutdb", "--bvh", "demo");
}, 900_000);
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

/** Returns the command's model of these files. */
function byCommand(files: string[], axes: string[], method: "som" | "em" = "som"): Uint8Array {
  const args = ["train-key-style", ...files, "--axes", axes.join(","), "--method", method, "-o", "model.strutkeys"];
  execFileSync(COMMAND, args, { cwd: folder, stdio: "pipe" });
  return readFileSync(join(folder, "model.strutkeys"));
}

/** Returns the page's model of these files. */
async function byPage(files: string[], axes: string[], em = false): Promise<Uint8Array> {
  const client = new BuildClient(() => new InlineBuildWorker());
  const dropped = files.map((path) => ({ path: basename(path), file: new File([readFileSync(path)], basename(path)) }));
  const order = { clips: [], action: "", axes, components: 0, em };
  const { file } = await client.trainKeyStyle(undefined, dropped, order);
  client.dispose();
  return file;
}

/** Not `toEqual`, which would print megabytes. */
function expectSame(page: Uint8Array, command: Uint8Array): void {
  expect(page.length).toBe(command.length);
  expect(page.findIndex((byte, i) => byte !== command[i])).toBe(-1);
}

const mocap = recordings();

describe("a key-style model", () => {
  const builtIn = () => ["walk_neutral_001", "walk_old_001"].map((name) => join(folder, "demo", `${name}.bvh`));

  test("of the built-in walks", async () => {
    expectSame(await byPage(builtIn(), AXES), byCommand(builtIn(), AXES));
  });

  test("of the built-in walks, by expectation and maximisation", async () => {
    const axes = AXES.slice(0, 2);
    expectSame(await byPage(builtIn(), axes, true), byCommand(builtIn(), axes, "em"));
  });

  test.skipIf(!mocap)("of recorded walks", { timeout: 300_000 }, async () => {
    const files = ["001", "002", "003"].map((take) =>
      join(mocap!, "bandai-namco-2", `dataset-2_walk_normal_${take}.bvh`),
    );
    expectSame(await byPage(files, AXES), byCommand(files, AXES));
  });

  test("a change of one variable does not go unnoticed", async () => {
    const page = await byPage(builtIn(), AXES.with(2, "hand_l.y - hips.x"));
    const command = byCommand(builtIn(), AXES);
    expect(page.some((byte, i) => byte !== command[i])).toBe(true);
  });

  test("makes the same motion of keys", async () => {
    const file = byCommand(builtIn(), AXES.slice(0, 2));
    const model = await KeyStyleModel.open(file);
    const keys = Array.from({ length: 9 }, (_, i) => {
      const angle = (2 * Math.PI * i) / 8;
      const values = [40 * Math.cos(angle), -8 * Math.sin(angle)].map((value) => Number(value.toFixed(2)));
      return { secs: Number((0.15 * i).toFixed(2)), values };
    });
    const table = keys.map(({ secs, values }) => [secs, ...values].join(",")).join("\n");
    writeFileSync(join(folder, "keys.csv"), `time,${AXES.slice(0, 2).join(",")}\n${table}\n`);
    const args = ["key-style", "--model", "model.strutkeys", "--keys", "keys.csv", "-o", "out.bvh"];
    execFileSync(COMMAND, args, { cwd: folder, stdio: "pipe" });
    const styling = model.styling();
    styling.set(keys, "spline");
    const page = styling.toBvh(keys.at(-1)!.secs, "style");
    expect(page === readFileSync(join(folder, "out.bvh"), "utf8")).toBe(true);
  });
});
