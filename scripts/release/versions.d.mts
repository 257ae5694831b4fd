/** The files that state the version, below the folder `root` that the functions here take; it is the project's by default. */
export function versionedFiles(): string[];
/** The version of package.json, which the others must have. */
export function currentVersion(root?: string): string;
/** What is wrong with the versions, a sentence each. */
export function versionFaults(root?: string): string[];
/** What is wrong with a release of this tag, a sentence each: `v1.2.3` needs the version and a dated section of changes. */
export function tagFaults(tag: string, root?: string): string[];
/** The changes of the newest section of the changelog, Markdown. */
export function newestChanges(root?: string): string;
/** Raises the version everywhere and gives the changelog's unreleased section its version and date (`2026-11-27`). */
export function raiseVersion(version: string, date: string, root?: string): void;
