/** A folder in which the package is installed, with a database, walks, and the command's output for them. */
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { everyNth } from "../clips";
import { buildPrograms, COMMAND } from "../programs";
import { root } from "../recordings";

/** Frames of `walk.bvh`. */
export const FRAMES = 60;

export interface Consumer {
  folder: string;
  /** The package's tarball. */
  tarball: string;
  /** Folder of the installed package. */
  installed: string;
  /** The walk in the style proud, as text of the command's output. */
  byCommand: string;
  remove(): void;
}

/** Packs dist/package/ and installs it in an empty folder, without network. */
export function installPackage(): Consumer {
  const built = join(root, "dist", "package");
  if (!existsSync(built)) throw new Error("dist/package/ is missing; run 'npm run package' first.");
  buildPrograms();
  const folder = mkdtempSync(join(tmpdir(), "strut-consumer-"));
  const run = (program: string, ...args: string[]) => execFileSync(program, args, { cwd: folder, stdio: "pipe" });
  const packed = run("npm", "pack", built, "--silent").toString().trim();
  writeFileSync(join(folder, "package.json"), '{ "name": "consumer", "private": true, "type": "module" }\n');
  run("npm", "install", "--offline", "--no-audit", "--no-fund", "--silent", `./${packed}`);
  symlinkSync(join(root, "node_modules", "three"), join(folder, "node_modules", "three"));
  run(COMMAND, "demo-db", "-o", "demo.strutdb", "--bvh", "demo");
  const walk = readFileSync(join(folder, "demo", "walk_neutral_001.bvh"), "utf8");
  mkdirSync(join(folder, "clips"));
  for (const style of ["neutral", "old", "proud"]) {
    const clip = `walk_${style}_001.bvh`;
    writeFileSync(join(folder, "clips", clip), everyNth(readFileSync(join(folder, "demo", clip), "utf8"), 2, 150));
  }
  rmSync(join(folder, "demo"), { recursive: true });
  writeFileSync(join(folder, "walk.bvh"), everyNth(walk, 1, FRAMES));
  run(COMMAND, ..."stylize --db demo.strutdb --input walk.bvh --style proud -o command.bvh".split(" "));
  const byCommand = readFileSync(join(folder, "command.bvh"), "utf8");
  return {
    folder,
    tarball: join(folder, packed),
    installed: join(folder, "node_modules", "strut-motion"),
    byCommand,
    remove: () => rmSync(folder, { recursive: true, force: true }),
  };
}

/** Returns the walk in a style of the built-in database, styled in Node without a bundler. */
export function styledByNode({ folder }: Consumer): string {
  const script = `import { readFileSync } from "node:fs";
import { loadStrut } from "strut-motion/node";
const strut = await loadStrut();
const motion = await strut.openMotion(readFileSync("walk.bvh", "utf8"));
const styled = await strut.stylize(motion, await strut.openDatabase("strut:walk"), { styles: { proud: 1 } });
process.stdout.write(styled.toBVH());
strut.dispose();`;
  return execFileSync(process.execPath, ["--input-type=module", "--eval", script], { cwd: folder, encoding: "utf8" });
}
