/** Size of the code that a page must load to write files. */
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build, type Rolldown } from "vite";
import { describe, expect, it } from "vitest";

/** A module of this folder with everything that it imports, in one minified file. */
async function bundled(file: string): Promise<Rolldown.OutputChunk> {
  const input = fileURLToPath(new URL(file, import.meta.url));
  const result = await build({
    configFile: false,
    publicDir: false,
    logLevel: "error",
    build: { write: false, target: "es2022", rolldownOptions: { input, preserveEntrySignatures: "strict" } },
  });
  return (result as Rolldown.RolldownOutput).output[0];
}

const WRITERS = [
  { file: "mannequin_glb.ts", limit: 10_000 },
  { file: "animation_clip.ts", limit: 2_000 },
  { file: "vrma.ts", limit: 2_500 },
];

describe.each(WRITERS)("$file", ({ file, limit }) => {
  it("is loaded without three.js or any other package", async () => {
    const { moduleIds, imports } = await bundled(file);
    expect(moduleIds.length).toBeGreaterThan(1);
    expect(moduleIds.filter((id) => id.includes("node_modules"))).toEqual([]);
    expect(imports).toEqual([]);
  });

  it(`takes no more than ${limit} bytes, compressed`, async () => {
    const { code } = await bundled(file);
    expect(code).toContain("export");
    expect(gzipSync(code, { level: 9 }).length).toBeLessThan(limit);
  });
});
