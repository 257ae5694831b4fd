/**
 * The models of Debian's `assimp-testmodels`, many of them broken on purpose. None is a body, and each must be refused
 * with a message.
 */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { extname, join } from "node:path";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { loadCharacter, loadMotions } from "../../web/character/load";
import { StrutError } from "../../web/engine/errors";

const FOLDER = "/usr/share/assimp/models";
const ENDINGS = [".fbx", ".glb", ".gltf", ".vrm"];

const files = existsSync(FOLDER)
  ? readdirSync(FOLDER, { recursive: true, encoding: "utf8" }).filter((path) =>
      ENDINGS.includes(extname(path).toLowerCase()),
    )
  : [];
if (files.length === 0) console.info(`Skipped: ${FOLDER} is missing (apt-get install assimp-testmodels).`);

beforeEach(() => {
  // three.js prints many messages about broken files.
  for (const method of ["warn", "error"] as const) vi.spyOn(console, method).mockImplementation(() => {});
  // Browser functions that three.js's loaders need; pictures cannot be loaded.
  vi.stubGlobal("window", { innerWidth: 1, innerHeight: 1 });
  vi.stubGlobal("document", { createElementNS: () => new NoPicture() });
  vi.stubGlobal("self", globalThis);
});

afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

/** An image element whose picture cannot be loaded. */
class NoPicture extends EventTarget {
  set src(_: string) {
    queueMicrotask(() => this.dispatchEvent(new Event("error")));
  }
}

/** Returns the message of a typed error of a call, or nothing. */
async function said(call: () => Promise<unknown>): Promise<string> {
  try {
    await call();
    return "loaded";
  } catch (error) {
    expect(error).toBeInstanceOf(StrutError);
    const { code, message } = error as StrutError;
    expect(["bad-file", "licence"]).toContain(code);
    return message;
  }
}

test.skipIf(files.length === 0)("every file loads or is refused in words", async () => {
  const answers = new Map<string, number>();
  let slowest = 0;
  for (const path of files) {
    const file = readFileSync(join(FOLDER, path));
    const buffer = () => Uint8Array.from(file).buffer;
    const start = performance.now();
    const figure = await said(async () => (await loadCharacter(buffer())).dispose());
    const motions = await said(async () => {
      for (const motion of await loadMotions(buffer())) motion.toBVH();
    });
    slowest = Math.max(slowest, performance.now() - start);
    const answer = `figure: ${figure} Motions: ${motions}`;
    answers.set(answer, (answers.get(answer) ?? 0) + 1);
  }
  const list = [...answers].map(([answer, count]) => `  ${count} × ${answer}`).join("\n");
  console.info(`${files.length} files, slowest ${slowest.toFixed(0)} ms\n${list}`);
});
