/**
 * Returns the files that contain the version, below the folder `root` of the functions here, by default the project's.
 */
export function versionedFiles(): string[];
/** Returns the version of package.json, which the others must have. */
export function currentVersion(root?: string): string;
/** Returns a message for each inconsistent version. */
export function versionFaults(root?: string): string[];
/**
 * Returns a message for each fault of a release with this tag: `v1.2.3` needs the version and a dated section of
 * changes.
 */
export function tagFaults(tag: string, root?: string): string[];
/** Returns the changes of the newest section of the changelog, as Markdown. */
export function newestChanges(root?: string): string;
/** Raises the version everywhere and gives the changelog's unreleased section its version and date (`2026-11-27`). */
export function raiseVersion(version: string, date: string, root?: string): void;
