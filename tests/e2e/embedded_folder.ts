/** A folder with the files for embedding Strut: the page for iframes, the scripts of the package, and a character. */
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { othersAbsent, rigOfOthers } from "../rigs/others";

/** The policy that docs/embedding.md recommends. */
export const POLICY = /```text\n(default-src 'none';[^`]*)```/
  .exec(readFileSync(join(root, "docs", "embedding.md"), "utf8"))?.[1]
  ?.replaceAll("\n", " ")
  .trim();

/** A player of the textured character, without other colours. */
export const PLAYER =
  '<script src="package/strut-player.js"></script><strut-player character="sophia.glb" ghost="off" styles="neutral" loading="eager"></strut-player>';

/** Returns a sandboxed iframe with the page for iframes and the parameters `query`. */
export const frameOf = (query: string): string =>
  `<iframe sandbox="allow-scripts" width="480" height="360" src="embed.html?${query}"></iframe>`;

/** Returns the parameters of {@link frameOf} for the textured character. */
export const characterOf = (url: string): string =>
  `${new URLSearchParams({ character: `${url}/sophia.glb`, ghost: "off", styles: "neutral" })}`;

/** Only the character itself may be read from other origins, as on the host of a character's author. */
const headersOf = (path: string): Record<string, string> =>
  path.endsWith(".glb") ? { "Access-Control-Allow-Origin": "*" } : {};

/**
 * Serves the folder as many hosts do (`site`) and under {@link POLICY} (`policed`). `write` puts a body into its index
 * page.
 */
export async function serveEmbedded() {
  const folder = mkdtempSync(join(tmpdir(), "strut-embedded-"));
  for (const file of ["embed", "embed.html"]) cpSync(join(root, "dist", file), join(folder, file), { recursive: true });
  for (const file of ["strut-player.js", "strut-character.js", "walk.bin", "walk.bin.js"])
    cpSync(join(root, "dist", "package", file), join(folder, "package", file), { recursive: true });
  if (!othersAbsent) writeFileSync(join(folder, "sophia.glb"), rigOfOthers("m2m-sophia.glb"));
  const [site, policed] = await Promise.all([
    serveFolder(folder, headersOf),
    serveFolder(folder, { "Content-Security-Policy": POLICY ?? "default-src 'none'" }),
  ]);
  return {
    site,
    policed,
    write: (body: string) =>
      writeFileSync(join(folder, "index.html"), `<!doctype html><meta charset="utf-8"><title>A page</title>${body}`),
    close: async () => {
      await site.close();
      await policed.close();
      rmSync(folder, { recursive: true });
    },
  };
}
