/** Test files as other programs write them, each of which exposes a possible reading error. */
import { existsSync } from "node:fs";
import { join, resolve } from "node:path";

/** `$STRUT_MOCAP/../cases`, else `shared/cases` next to the repository. */
const FOLDERS = [
  ...(process.env.STRUT_MOCAP ? [resolve(process.env.STRUT_MOCAP, "../cases/files")] : []),
  resolve(import.meta.dirname, "../../shared/cases/files"),
];
const FOLDER = FOLDERS.find((folder) => existsSync(folder)) ?? FOLDERS.at(-1)!;

/** Returns the path of a test file by its name without extension. */
export const caseFile = (name: string): string => join(FOLDER, `${name}.bvh`);

/** Whether the files are missing on this machine; prints this once. */
export const casesAbsent = !existsSync(caseFile("00_clean"));
if (casesAbsent) console.info(`Skipped: ${FOLDER} has no files of other programs.`);
