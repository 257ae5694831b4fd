/** Texts about several dropped motions, and about a batch. Loaded on first use. */
import { grouped } from "../strings/numerals";

const counted = (one: string) => (n: number) => `${grouped(n)} ${n === 1 ? one : `${one}s`}`;
const [motions, files] = [counted("motion"), counted("file")];
const quoted = (name: string) => `“${name}”`;
const megabytes = (bytes: number) => `${(bytes / 1e6).toFixed(1)} MB`;

export const batchWords = {
  // --- what to do with them ---
  heading: motions,
  looking: "Looking for motions.",
  inputs: "Use as inputs",
  inputsWhat: "The first one plays at once; choose the others as the input.",
  restyle: "Restyle all…",
  restyleWhat: "Each in one or several styles: a zip of BVH files on their own skeletons.",
  database: "Make a database",
  databaseWhat: "Your own styles: file names give the action and the style, for example walk_old_1.bvh.",
  cancel: "Cancel",
  reading: (n: number) => `Reading ${motions(n)}.`,
  tooMany: (n: number, most: number) =>
    `${motions(n)} are too many for inputs: the limit is ${most}, and 1 GB in total. Restyle them, or make a database.`,
  notRead: (path: string, why: string) => `${quoted(path)} was left out. ${why}`,
  added: (n: number) => `${motions(n)} are inputs now: choose among them beside “Input”.`,

  // --- settings of restyling ---
  setup: (n: number) => `Restyle ${motions(n)}`,
  styles: "Styles",
  present: (manner: string) => `As in Play: ${manner}`,
  single: "Each of these styles alone",
  style: (name: string) => name,
  result: (made: number, folders: number) =>
    `${files(made)}${folders > 1 ? ` in ${folders} folders` : ""}. Uses the database, model and options of Play, but no style keys.`,
  none: "Choose a style.",
  start: "Restyle",
  busy: "Another batch is not finished. Save or close it first.",

  // --- while it runs ---
  name: "Batch",
  preparing: "Preparing the styles.",
  running: (n: number) => `Restyling ${motions(n)}`,
  progress: (done: number, all: number) => `${grouped(done)} of ${files(all)}`,
  leftOut: (n: number) => `${grouped(n)} left out`,
  left: (seconds: number) =>
    seconds < 90
      ? `about ${Math.max(1, Math.round(seconds / 10) * 10)} s left`
      : `about ${Math.round(seconds / 60)} min left`,
  stop: "Cancel",

  // --- when it has ended ---
  done: (n: number) => `${files(n)} ${n === 1 ? "is" : "are"} done`,
  stopped: (done: number, all: number) => `Stopped: ${grouped(done)} of ${files(all)}`,
  why: (n: number) => `${motions(n)} left out`,
  because: (path: string, why: string) => `${quoted(path)}: ${why}`,
  save: (bytes: number) => `Save zip, ${megabytes(bytes)}`,
  again: "Save again",
  resume: "Continue",
  close: "Close",
  saved: (name: string, bytes: number) => `Saved ${name}, ${megabytes(bytes)}.`,
  discarded: (n: number) =>
    `${n === 1 ? "1 unsaved file was" : `${grouped(n)} unsaved files were`} discarded with the batch.`,
  undo: "Undo",
} as const;
