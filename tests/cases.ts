/** Files as other programs write them, which fail where a file is read wrongly (`shared/spec/real-files.md`). */
import { existsSync } from "node:fs";
import { join, resolve } from "node:path";

/** `$STRUT_MOCAP/../cases`, else `shared/cases` beside the repository. */
const FOLDERS = [
  ...(process.env.STRUT_MOCAP ? [resolve(process.env.STRUT_MOCAP, "../cases/files")] : []),
  resolve(import.meta.dirname, "../../shared/cases/files"),
];
const FOLDER = FOLDERS.find((folder) => existsSync(folder)) ?? FOLDERS.at(-1)!;

/** Path of a case by its name without ending. */
export const caseFile = (name: string): string => join(FOLDER, `${name}.bvh`);

/** Whether there are none on this machine; says so once. */
export const casesAbsent = !existsSync(caseFile("00_clean"));
if (casesAbsent) console.info(`Skipped: ${FOLDER} has no files of other programs.`);
