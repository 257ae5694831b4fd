/** The page builds the same databases as the command, byte for byte: from folders, from archives, with a table. */
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { BuildClient } from "../../web/client/build/client";
import type { ChosenFile, DroppedFile } from "../../web/client/build/protocol";
import { InlineBuildWorker } from "../inline_build_worker";
import { buildPrograms, COMMAND } from "../programs";
import { recordings } from "../recordings";
import { zipOf } from "../zip";

let folder: string;
beforeAll(() => {
  buildPrograms();
  folder = mkdtempSync(join(tmpdir(), "strut-parity-"));
}, 900_000);
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

/** Returns the files of a folder as a page receives them in a drop. */
function dropped(name: string): DroppedFile[] {
  return readdirSync(join(folder, name), { recursive: true, encoding: "utf8" })
    .filter((path) => path.includes("."))
    .concat(readdirSync(join(folder, name)).includes("LICENSE") ? ["LICENSE"] : [])
    .map((path) => ({ path: `${name}/${path}`, file: fileOf(join(folder, name, path)) }));
}

function fileOf(path: string): File {
  return new File([readFileSync(path)], basename(path));
}

/** Returns the command's database of an input in the folder. */
function byCommand(input: string, ...more: string[]): Uint8Array {
  execFileSync(COMMAND, ["build-db", input, "-o", "out.strutdb", ...more], { cwd: folder, stdio: "pipe" });
  return readFileSync(join(folder, "out.strutdb"));
}

/** Returns the page's database of these files. */
async function byPage(files: DroppedFile[], neutral: string, pattern?: string, table?: File): Promise<Uint8Array> {
  const client = new BuildClient(() => new InlineBuildWorker());
  const { clips } = await client.open(files);
  const labels = await client.label(pattern, table);
  const chosen = clips.flatMap(({ path, licence }, index): ChosenFile[] => {
    const label = labels[index]!;
    return "reason" in label ? [] : [{ ...label, index, path, licence, roles: undefined }];
  });
  const { file } = await client.build(chosen, neutral);
  return new Uint8Array(await file.arrayBuffer());
}

/** Not `toEqual`, which would print megabytes. */
function expectSame(page: Uint8Array, command: Uint8Array): void {
  expect(page.length).toBe(command.length);
  expect(page.findIndex((byte, i) => byte !== command[i])).toBe(-1);
}

describe("the built-in motions as BVH files", () => {
  beforeAll(() => {
    execFileSync(COMMAND, ["demo-db", "-o", join(folder, "demo.strutdb"), "--bvh", join(folder, "all")], {
      stdio: "pipe",
    });
    mkdirSync(join(folder, "demo/more"), { recursive: true });
    const names = ["jump_neutral_001", "jump_old_001", "run_neutral_001", "run_proud_001", "run_old_001"];
    for (const [i, name] of names.entries())
      copyFileSync(join(folder, "all", `${name}.bvh`), join(folder, i < 3 ? "demo" : "demo/more", `${name}.bvh`));
    writeFileSync(join(folder, "demo/LICENSE"), "Licence for tests\n");
  });

  test("in a folder", async () => {
    const page = await byPage(dropped("demo"), "neutral", "{action}_{style}_{take}.bvh");
    expectSame(page, byCommand("demo"));
    expect(new TextDecoder().decode(page.subarray(0, 20_000))).toContain("Licence for tests");
  });

  test("in an archive, labelled by a table and with another neutral style", async () => {
    const names = readdirSync(join(folder, "demo")).filter((name) => name !== "more");
    const packed = names.map((name) => ({ name: `in/${name}`, content: readFileSync(join(folder, "demo", name)) }));
    writeFileSync(join(folder, "demo.zip"), zipOf(packed));
    const table = "file,action,style\njump_neutral_001.bvh,歩き,\"old, 'very' <b>\"\nrun_neutral_001.bvh,歩き,x\n";
    writeFileSync(join(folder, "labels.csv"), table);
    const files = [{ path: "demo.zip", file: fileOf(join(folder, "demo.zip")) }];
    const page = await byPage(files, "x", undefined, fileOf(join(folder, "labels.csv")));
    expectSame(page, byCommand("demo.zip", "--labels", "labels.csv", "--neutral", "x"));
  });

  test("with a clip as one more style", async () => {
    writeFileSync(join(folder, "known.strutdb"), byCommand("demo"));
    copyFileSync(join(folder, "all/run_angry_001.bvh"), join(folder, "clip.bvh"));
    const add = ["add-style", "--db", "known.strutdb", "--input", "clip.bvh", "--style", "cross", "-o", "more.strutdb"];
    execFileSync(COMMAND, add, { cwd: folder, stdio: "pipe" });
    const client = new BuildClient(() => new InlineBuildWorker());
    const { file, styles } = await client.addStyle(
      fileOf(join(folder, "known.strutdb")),
      fileOf(join(folder, "clip.bvh")),
      "cross",
    );
    expect(styles).toEqual(["neutral", "old", "proud", "cross"]);
    expectSame(new Uint8Array(await file.arrayBuffer()), readFileSync(join(folder, "more.strutdb")));
  });

  test("a change of one number does not go unnoticed", async () => {
    const files = dropped("demo");
    const text = await files[0]!.file.text();
    files[0]!.file = new File(
      [text.replace(/(\d)(\s*)$/, (_, digit, end) => `${(Number(digit) + 1) % 10}${end}`)],
      "x",
    );
    const page = await byPage(files, "neutral", "{action}_{style}_{take}.bvh");
    const command = byCommand("demo");
    expect(page.some((byte, i) => byte !== command[i])).toBe(true);
  });
});

const mocap = recordings();

describe.skipIf(!mocap)("recorded clips", () => {
  for (const [set, pattern, neutral, wanted] of [
    ["xia", "{style}_{action}_{take}.bvh", "neutral", /^(neutral|old|angry)_(01|22)_/],
    [
      "bandai-namco-2",
      "{set}_{action}_{style}_{take}.bvh",
      "normal",
      /_(walk|wave-both-hands)_(normal|elderly)_00[12]/,
    ],
  ] as const)
    test(set, { timeout: 300_000 }, async () => {
      mkdirSync(join(folder, set));
      for (const name of readdirSync(join(mocap!, set)).filter((name) => wanted.test(name) || name === "LICENSE"))
        copyFileSync(join(mocap!, set, name), join(folder, set, name));
      expectSame(await byPage(dropped(set), neutral, pattern), byCommand(set, "--pattern", pattern));
    });
});
