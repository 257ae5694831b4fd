/**
 * Third-party rigged characters (`$STRUT_CASES/rigs`, else `shared/cases/rigs` next to the repository, with a README).
 */
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";

const FOLDERS = [
  ...(process.env.STRUT_CASES ? [resolve(process.env.STRUT_CASES, "rigs"), resolve(process.env.STRUT_CASES)] : []),
  ...(process.env.STRUT_MOCAP ? [resolve(process.env.STRUT_MOCAP, "../cases/rigs")] : []),
  resolve(import.meta.dirname, "../../../shared/cases/rigs"),
];
const FOLDER = FOLDERS.find((folder) => existsSync(join(folder, "m2m-sophia.glb"))) ?? FOLDERS.at(-1)!;

/** Returns the bytes of a third-party character. */
export const rigOfOthers = (name: string): Uint8Array<ArrayBuffer> => new Uint8Array(readFileSync(join(FOLDER, name)));

/** Whether the files are missing on this machine; prints this once. */
export const othersAbsent = !existsSync(join(FOLDER, "m2m-sophia.glb"));
if (othersAbsent) console.info(`Skipped: ${FOLDER} has no characters of other people.`);

/**
 * Stubs of the browser functions that three.js's loaders need besides numbers: Node has no pictures, so textures stay
 * empty.
 */
export function withoutPictures(): void {
  const image = () => {
    const listeners = new Map<string, () => void>();
    return {
      addEventListener: (name: string, listener: () => void) => listeners.set(name, listener),
      removeEventListener: (name: string) => listeners.delete(name),
      set src(_: string) {
        setTimeout(() => listeners.get("error")?.());
      },
    };
  };
  Object.assign(globalThis, {
    self: globalThis,
    window: { innerWidth: 1, innerHeight: 1 },
    document: { createElementNS: image },
  });
}
