/** Texts of the Data view. */
import { counted } from "../../strings/counted.en";
import { grouped } from "../../strings/numerals";

const [clips, styles] = [counted("clip"), counted("style")];
const quoted = (name: string) => `“${name}”`;

/** Names in quotes; of many only the first few. */
function listed(names: readonly string[]): string {
  const first = names.slice(0, 3).map(quoted);
  const more = names.length - first.length;
  return more > 0 ? `${first.join(", ")} and ${more} more` : first.join(" and ");
}

export const data = {
  empty: {
    heading: "Your own styles",
    what: "Drop BVH files, a folder or a zip of them here. File names give the action and the style, for example walk_old_1.bvh; the rest is detected. Nothing leaves this device.",
    best: "The same actions in every style work best: walk, run and jump, in neutral and in others. A CSV with the columns file, action, style works, too.",
    files: "Choose files",
    folder: "Choose a folder",
  },
  add: { files: "Add files", folder: "Add a folder", clear: "Clear" },
  looking: "Looking for clips.",
  noClips: "There is no BVH among these files. Drop BVH files, a folder or a zip of them.",
  noneOf: (n: number) => `${counted("file")(n)} dropped, but no BVH and no zip among them.`,

  names: {
    label: "File names",
    pattern: "Pattern of the file names",
    all: "all match",
    some: (matching: number, all: number) => `${grouped(matching)} of ${grouped(all)} match`,
    tableFirst: (matches: string, table: string) => `${matches}; ${table} takes precedence`,
  },
  leftOut: "Left out",
  leftOutCount: (n: number) => `${grouped(n)} left out`,
  heading: (n: number, ofStyles: number) => `${clips(n)}, ${styles(ofStyles)}`,
  summary: (actions: number, source: string) => `${counted("action")(actions)} · ${source}`,
  sources: counted("source"),
  unlabelled: "It needs an action and a style.",
  oneStyle: "Only one style so far. Add a second one to mix with.",
  single: (names: readonly string[]) =>
    `${listed(names)} ${names.length === 1 ? "has" : "have"} only one clip. More clips give better results.`,
  missing: (names: readonly string[], action: string) =>
    `${listed(names)} ${names.length === 1 ? "has" : "have"} no “${action}”: it will be guessed from other actions.`,
  unnamed: "My clips",

  matrix: {
    name: "Styles and actions",
    style: "Style",
    neutral: "Neutral",
    isNeutral: (style: string) => `${style} is neutral`,
    rename: {
      action: (name: string) => `Name of the action ${name}`,
      style: (name: string) => `Name of the style ${name}`,
    },
    cell: (action: string, style: string, clips: number) => `${action}, ${style}: ${clips}`,
  },

  list: {
    name: "Clips",
    columns: {
      file: "File",
      action: "Action",
      style: "Style",
      take: "Take",
      length: "Length",
      rate: "Rate",
      note: "Note",
    },
    field: {
      action: (file: string) => `action of ${file}`,
      style: (file: string) => `style of ${file}`,
      take: (file: string) => `take of ${file}`,
    },
    seconds: (secs: string) => `${secs} s`,
    hertz: (rate: string) => `${rate} Hz`,
    skeleton: (number: number, joints: number) => `skeleton ${number}, ${counted("joint")(joints)}`,
  },

  preview: {
    name: "Preview",
    invitation: "Choose a clip to see it.",
    title: (action: string, style: string) => `${action}, ${style}`,
    note: (frames: number, secs: string, note: string) => `${counted("frame")(frames)}, ${secs} s. ${note}`,
  },

  build: {
    heading: "Database",
    panels: "Database",
    name: "Name",
    nameOf: "Name of the database",
    build: "Build the database",
    building: "Building",
    progress: "Building.",
    more: (n: number) => `${counted("more remark")(n)} like these.`,
    skeleton: (number: number) => (number > 1 ? `Skeleton ${number}` : "Skeleton"),
    joints: "Joints",
    checkJoints: "Check joints",
    jointsOf: (number: number) => `Joints of skeleton ${number}`,
    chosen: "chosen by you",
    unmatched: "not matched",
    matched: (percent: number) => `matched, ${percent} % sure`,
    has: (joints: number, n: number) => `${counted("joint")(joints)}, ${clips(n)}`,
    ready: (number: string, n: number, frames: number, secs: string) =>
      `${number} ${n === 1 ? "style" : "styles"} ready. ${grouped(frames)} frames, ${secs} s.`,
    open: "It is now open.",
    play: "Play with it",
    refused: (n: number) => `${clips(n)} left out.`,
    unkept: (name: string, why: string) => `${quoted(name)} is ready, but it will not be here after a reload. ${why}`,
  },

  replace: {
    heading: (name: string) => `A database ${quoted(name)} exists`,
    what: (contents: string) => `It has ${contents}. Replace it, or keep both and number the new one?`,
    replace: "Replace it",
    keepBoth: "Keep both",
  },

  manners: {
    heading: "Takes that differ",
    note: "Some takes of a style differ from its other takes, so the result would be an average of both. Split them into two styles and build again to keep both.",
    differ: (action: string, style: string) => `${quoted(style)} in ${quoted(action)}`,
    takes: (numbers: string) => `takes ${numbers}`,
    and: "and",
    show: "Show",
    divide: "Split into two styles",
    does: (what: string, action: string, style: string) => `${what}: ${style} in ${action}`,
  },

  saved: {
    heading: "Databases",
    kept: "Stored in this browser, on this device.",
    someUnkept: "Databases that are not kept are lost when the page closes.",
    none: "Databases that you build are stored here.",
    builtIn: "Built-in",
    comesAlong: "comes with the page",
    open: "Open",
    export: "Export",
    delete: "Delete",
    deleted: "deleted",
    restore: "Undo deletion of",
    does: (what: string, name: string) => `${what} ${name}`,
    contents: (ofStyles: number, n: number, size: string) => `${styles(ofStyles)}, ${clips(n)}, ${size}`,
    isOpen: (contents: string) => `open · ${contents}`,
    unkept: (contents: string) => `not kept · ${contents}`,
    full: "The browser has no room left for it. Delete a database, or export this one before the page is closed.",
    refused: "The browser does not let this page keep files, as in a private window. Export the database to keep it.",
    newer: "A newer version of Strut has upgraded the databases of this device.",
    reload: "Reload the page to use them.",
  },

  sets: {
    heading: "Public data sets",
    note: "Data sets by other authors. Each has its own licence, which is shown before the download.",
    get: "Get",
    resume: "Resume",
    use: "Use",
    here: "on this device",
    files: counted("file"),
    some: (kept: number, all: number) => `${kept} of ${counted("file")(all)}`,
    state: (licence: string, state: string) => `${licence} · ${state}`,
    fetching: (name: string) => `Downloading ${name}.`,
    arrived: (name: string, n: number, all: number, size: string) =>
      `${name}: ${counted("file")(n)} of ${all}, ${size}.`,
    licence: "Licence: ",
    about: (text: string) => `${text}.`,
    licenceNote: (note: string) => `. ${note}`,
    cite: (citation: string) => `Cite it as: ${citation}.`,
    more: "More about it",
    from: (host: string) => `Downloads from ${host}, and stores it in this browser.`,
    fromSized: (host: string, size: string) => `Downloads ${size} from ${host}, and stores it in this browser.`,
    download: "Download",
    noList: "The list of public data sets could not be loaded.",
    badList: (at: string, what: string) => `The list of public data sets is invalid: ${at} should be ${what}.`,
    noCache: "The browser does not let this page keep files, as in a private window.",
    dropHere: "Drop the files here.",
    cancelled: "Cancelled.",
    notKept: (file: string) => `The browser did not store ${file}.`,
    again: "Download the set again.",
    offline: "There is no network connection.",
    unreachable: (host: string) => `${host} cannot be reached, or does not allow other pages to read its files.`,
    answered: (host: string, status: number, file: string) => `${host} answered ${status} for ${file}.`,
    byHand: (page: string) => `Get the files from ${page} and drop them here.`,
    changed: (file: string) => `${file} differs from the file in the list of public data sets, and was discarded.`,
    full: (name: string) => `The browser has no room for ${name}.`,
    makeRoom: "Delete databases or other sets.",
    brokeOff: (file: string, size: string) => `The download of ${file} stopped after ${size}.`,
    tryAgain: "Try again: the part already downloaded is kept.",
  },

  style: {
    heading: "A new style",
    name: "Name of the style",
    nameLabel: "Name",
    action: "Action of the clip",
    actionLabel: "Action",
    found: "found in the clip",
    tooShort: (secs: string) => `The clip lasts ${secs} s. It needs at least 1 s; for a walk, two cycles are better.`,
    brief: (secs: string) =>
      `The clip lasts only ${secs} s: its action may be wrong. For a walk, two cycles are better.`,
    make: "Make it a style",
    taken: (name: string) => `A style ${quoted(name)} already exists.`,
    unnamed: "new style",
    database: (base: string, style: string) => `${base} + ${style}`,
  },

  cancel: "Cancel",
};
