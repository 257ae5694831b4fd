/** Texts about project files and files stored for a tab. Loaded on first use. */
import { counted } from "../strings/counted.en";

const motions = counted("motion");
const quoted = (name: string) => `“${name}”`;

export const projectWords = {
  /** Name of the progress card for screen readers. */
  task: "Project",

  // --- a file that cannot be read; its name comes first ---
  refused: (name: string, why: string) => `${quoted(name)} was not opened. ${why}`,
  noProject: "It is not a Strut project, or it is incomplete. Save it again, or copy it again from the source.",
  damaged: (why: string) => `It is damaged. ${why}`,
  unreadable: "It could not be read. Choose it again.",
  noJson: "It is damaged: its “project.json” is not JSON.",
  wrong: (field: string) => `It is damaged: its “project.json” has no valid “${field}”.`,
  missing: (path: string) => `It is damaged: ${quoted(path)} is missing.`,
  twice: (path: string) => `It is damaged: it contains ${quoted(path)} twice.`,
  tooMany: (n: number, most: number) => `It has ${n} motions; the limit is ${most}.`,
  newer: (version: number, known: number) =>
    `A newer version of Strut saved it: its format is ${version}, and this page reads format ${known}. Reload the page to update Strut.`,
  older: (version: number, known: number) =>
    `Its format ${version} is too old for this page, which reads format ${known}.`,
  motionRefused: (name: string, why: string) => `The motion ${quoted(name)} in it cannot be used. ${why}`,
  databaseRefused: (name: string, why: string) => `The database ${quoted(name)} in it cannot be used. ${why}`,
  characterRefused: (name: string, why: string) => `The character ${quoted(name)} in it cannot be used. ${why}`,

  // --- opening ---
  reading: "Reading the project.",
  checking: (name: string) => `Checking ${name}.`,
  opened: (name: string) => `Opened ${quoted(name)}.`,
  back: "Go back",
  characterMissing: (name: string) =>
    `This project uses the character ${quoted(name)}, which is not in its file. Drop the character here.`,
  characterOther: (name: string) => `${quoted(name)} is not the character of this project.`,

  // --- saving ---
  saving: "Saving the project.",
  heading: "Save project",
  name: "Name",
  inside: "In the file",
  settings: "Styles, view, camera, time and all settings",
  motions,
  database: (name: string) => `Database ${quoted(name)}`,
  builtIn: "Built-in database, by name only",
  character: (name: string) => `Character ${quoted(name)}`,
  characterInside: "Include the character",
  characterLeft: "Without it, Strut asks for the character when the project is opened.",
  characterLicence:
    "Its licence does not allow redistribution. Include it only for your own use; without it, Strut asks for the file when the project is opened.",
  size: (bytes: number) =>
    bytes < 1000 ? `${bytes} B` : bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`,
  before: "before packing",
  save: "Save",
  share: "Share…",
  cancel: "Cancel",
  saved: (name: string, size: string) => `Saved ${name}, ${size}.`,
  notShared: "The browser cannot share this file. It was saved instead.",

  // --- files stored for a tab ---
  notKept: (why: string) => `Dropped files will not be here after a reload. ${why} Save a project to keep them.`,
  full: "The browser has no room for them.",
  noStorage: "The browser does not allow this page to store files, as in a private window.",
  forgotten: "The dropped files were removed from this browser.",
  undo: "Undo",
  gone: "Some dropped files of this tab could not be restored. Drop them again.",
} as const;
