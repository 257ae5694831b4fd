/** Texts about project files and files stored for a tab. Loaded on first use. */
import { counted } from "../strings/counted.en";

const motions = counted("motion");
const quoted = (name: string) => `“${name}”`;

export const projectWords = {
  /** Name of the progress card for screen readers. */
  task: "Project",

  // --- a file that cannot be read; its name comes first ---
  refused: (name: string, why: string) => `${quoted(name)} was not opened. ${why}`,
  noProject: "It is no project of Strut, or its end is missing. Save it again, or copy it again from where it came.",
  damaged: (why: string) => `It is damaged. ${why}`,
  unreadable: "It could not be read. Choose it again.",
  noJson: "It is damaged: “project.json” in it is no JSON.",
  wrong: (field: string) => `It is damaged: “project.json” in it has no usable “${field}”.`,
  missing: (path: string) => `It is damaged: ${quoted(path)} is missing in it.`,
  twice: (path: string) => `It is damaged: ${quoted(path)} is in it twice.`,
  tooMany: (n: number, most: number) => `It has ${n} motions; up to ${most} work.`,
  newer: (version: number, known: number) =>
    `A newer Strut saved it: its format is ${version}, and this page knows format ${known}. Reload the page to have the newest Strut.`,
  older: (version: number, known: number) =>
    `Its format is ${version}, which this page does not read any more: it knows format ${known}.`,
  motionRefused: (name: string, why: string) => `The motion ${quoted(name)} in it cannot be used. ${why}`,
  databaseRefused: (name: string, why: string) => `The database ${quoted(name)} in it cannot be used. ${why}`,
  characterRefused: (name: string, why: string) => `The character ${quoted(name)} in it cannot be used. ${why}`,

  // --- opening ---
  reading: "Reading the project.",
  checking: (name: string) => `Checking ${name}.`,
  opened: (name: string) => `Opened ${quoted(name)}.`,
  back: "Go back",
  characterMissing: (name: string) =>
    `This project was made with the character ${quoted(name)}, which is not in its file. Drop it here.`,
  characterOther: (name: string) => `${quoted(name)} is not the character that the project was made with.`,

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
  characterInside: "Put the character into the file",
  characterLeft: "Without it, whoever opens the project is asked for the character.",
  characterLicence:
    "Its licence does not allow redistribution. Include it only for your own use; without it, Strut asks for the file when the project is opened.",
  size: (bytes: number) =>
    bytes < 1000 ? `${bytes} B` : bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`,
  before: "before packing",
  save: "Save",
  share: "Share…",
  cancel: "Cancel",
  saved: (name: string, size: string) => `Saved ${name}, ${size}.`,
  notShared: "The browser does not share this file. It was saved instead.",

  // --- files stored for a tab ---
  notKept: (why: string) => `Dropped files will not be here after a reload. ${why} Save a project to keep them.`,
  full: "The browser has no room for them.",
  noStorage: "The browser keeps nothing for this page, as in a private window.",
  forgotten: "The dropped files are forgotten.",
  undo: "Undo",
  gone: "Some dropped files of this tab could not be brought back. Drop them again.",
} as const;
