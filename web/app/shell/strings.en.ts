import { counted } from "../strings/counted.en";

const styles = counted("style");
const frames = counted("frame");

/** Texts of the whole page: titles, menus, toasts, errors. */
export const page = {
  views: {
    play: "Play",
    learn: "Learn",
    compare: "Compare",
    walk: "Walk",
    "key-style": "Key-style",
    crowd: "Crowd",
    data: "Data",
  },
  title: (view: string) => `${view} · Strut`,
  viewShown: (view: string) => `${view} view`,
  reload: "Reload",
  dismiss: "Dismiss",
  tryAgain: "Try again",
  viewNotLoaded: (why: string) => `This view could not be loaded. Reload the page. ${why}`.trim(),
  partNotLoaded: "A part of this page could not be loaded. Check the connection, then try again or reload the page.",
  viewOffline: "This view could not be loaded because there is no network. Connect, then try again.",
  pictureLost:
    "The browser stopped the 3D graphics. Your motion and settings are still here: save your work, then reload the page.",
  oldBrowser:
    "This browser is too old for Strut. It needs Chrome or Edge 123, Firefox 125, Safari 17.5, or a newer one.",
  notBuilt: (why: string) => `Strut could not start. Reload the page, or try another browser. ${why}`,
  noWebGl:
    "Strut needs WebGL 2, which is not available in this browser. Turn on hardware acceleration, or use another browser. The lessons still work, without 3D.",

  bar: {
    undo: "Undo",
    redo: "Redo",
    share: "Share",
    embed: "Embed",
    theme: "Theme",
    help: "Help",
    lightOrDark: "Light or dark",
    lightTheme: "Light theme",
    darkTheme: "Dark theme",
    menu: "Menu",
    home: "Strut home",
    views: "Views",
    project: "Project",
  },

  project: {
    why: "Open, save or share all of your work as one file",
    open: "Open…",
    openWhat: "a project, motion, character or database",
    save: "Save…",
    saveWhat: "settings, dropped files and styles in one file",
    menuSave: "Save project…",
    forget: "Forget",
    menuForget: (n: number) => (n === 1 ? "Forget the dropped file" : `Forget ${n} dropped files`),
    kept: (n: number, megabytes: string) =>
      `${n === 1 ? "1 dropped file" : `${n} dropped files`}, ${megabytes} MB: here after a reload, until this tab is closed.`,
  },

  outputs: {
    export: "Export",
    why: "Save what you made as a file",
    size: "Size of pictures",
    asOnScreen: "as on screen",
    what: {
      bvh: "the motion on the input's own skeleton",
      glb: "the character with the animation",
      vrma: "the motion alone, for any VRM",
      webm: "a video of what you see",
      mp4: "the same, for programs that cannot open WebM",
      png: "this picture",
      csv: "times, contacts and class weights, one row per frame",
      jsonl: "the same, one line per frame",
    },
    saved: (name: string) => `Saved ${name}.`,
    noPicture: "The browser could not make the picture. Choose a smaller size, or reload the page.",
    videoTooLong: (minutes: number, most: number) =>
      `The video would last ${Math.ceil(minutes)} minutes; at most ${most} can be recorded. Choose a shorter range, or a higher speed.`,
    noVideo: "This browser does not record video. Use the GLB in another program, or another browser.",
    recording: "Recording.",
  },

  drop: {
    invitation:
      "Drop a motion (BVH, VRMA, or a GLB or FBX with one), a character (GLB, glTF with its files, VRM, FBX), a project, several motions, or a folder or zip of them. Any humanoid skeleton works.",
    file: "Motion, character, database or project",
    tooLarge: (name: string, megabytes: number, max: number) =>
      `“${name}” has ${megabytes} MB; the limit is ${max} MB. Export a shorter part.`,
    unknown: (name: string) =>
      `“${name}” is not a supported file. Drop a motion (.bvh, .vrma), a project (.strut), a database (.strutdb) or a character (.glb, .gltf, .vrm, .fbx).`,
    projectAlone: "A project was dropped with other files. Drop only the project: it contains its own files.",
    unreadable: (name: string) => `“${name}” could not be read. Drop it again.`,
    style: "Drop a walk here to make it a style.",
    styleFile: "Clip that becomes a style",
    choose: "Choose joints…",
    oneUnreadable: "A file could not be read. Drop it again.",
  },

  links: {
    copied: "Link copied.",
    copiedWithMotion: "Link copied, with the motion in it.",
    copiedWithoutMotion: "Link copied. The dropped file is too large for a link: send a project file instead.",
    saveProject: "Save project…",
    fileMissing: (name: string) => `This link uses “${name}”, a file that it does not contain. Drop the file here.`,
    databaseMissing: (name: string) => `This link uses the database “${name}”, which is not on this device.`,
    databaseRefused: (name: string) => `The database “${name}” could not be opened; another one is open instead.`,
    copyThis: "The browser does not allow this page to copy. Copy the link here:",
    link: "Link",
  },

  roles: {
    heading: "Joint mapping",
    none: "none",
    use: "Use these joints",
  },

  characters: {
    reading: (name: string) => `Reading ${name}.`,
    performs: (name: string) => `“${name}” is now the character.`,
    unsure: (name: string) =>
      `“${name}” is now the character. Its joint names are unusual: if a limb moves wrongly, check the joints.`,
    otherMotions: (others: number) =>
      others === 1
        ? "The file holds one more motion: choose it as the input."
        : `The file holds ${others} more motions: choose one as the input.`,
    missing: (roles: readonly string[]) => (roles.length > 0 ? `Missing: ${roles.join(", ")}.` : ""),
    check: "Check joints",
    back: "Back to the mannequin",
    by: (authors: readonly string[]) => `by ${authors.join(", ")}`,
    notForAll: "Restricted use",
    terms: (title: string) => `The author of “${title}” restricts who may perform with it. `,
    untitled: "this model",
    read: "Read the terms.",
    allowed: "I have permission",
    noExport:
      "This character’s licence does not allow redistribution with a new motion. Export the motion only: VRMA or BVH.",
  },

  sentFiles: {
    sent: (names: readonly string[]) => {
      const what = names.length === 1 ? `“${names[0]}”` : counted("file")(names.length);
      return `Another page or app sent ${what}. Open only what you shared yourself.`;
    },
    open: "Open",
  },
  update: { ready: "A newer version of Strut is ready.", action: "Update" },
  progress: { cancel: "Cancel", done: "Done.", stopped: "Stopped." },
  engine: {
    restarted: (why: string) => `The engine crashed and was restarted. Your settings are kept. ${why}`,
    restartedWithout: (lost: readonly string[], why: string, reason: string) =>
      `The engine crashed and was restarted, but the ${lost.join(" and the ")} ${lost.length > 1 ? "were lost: open them" : "was lost: open it"} again. ${why} ${reason}`,
    preparing: "Preparing the styles.",
    reading: (name: string) => `Reading ${name}.`,
    styling: "Styling the whole motion.",
    exporting: "Exporting.",
    registering: (name: string) => `Registering ${name}.`,
    noInput: (name: string) => `There is no input “${name}” here. Choose another or drop a BVH.`,
    stylesReady: (ofStyles: number, ofFrames: number) => `${styles(ofStyles)} ready. ${frames(ofFrames)}.`,
    made: (style: string, action: string, ofStyles: number) =>
      `“${style}” was made from the action “${action}” and changes no other. ${styles(ofStyles)} ready.`,
    change: "Change…",
    notKept: (style: string, why: string) => `“${style}” will not be here after a reload. ${why}`,
    cancelled: "Cancelled.",
    silentFailure: "An unknown error occurred.",
  },

  numbers: [
    "none",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
  ] as readonly string[],
  manner: {
    opposite: (style: string) => `the opposite of ${style}`,
    little: (style: string) => `a little ${style}`,
    very: (style: string) => `very ${style}`,
    mostly: (style: string) => `mostly ${style}`,
    two: (first: string, second: string) => `${first} and ${second}`,
    mix: (count: string) => `a mix of ${count} styles`,
    exaggerated: (manner: string) => `${manner}, exaggerated`,
    title: (action: string, manner: string) => `${action}, ${manner}`,
  },

  /** The line under the title. */
  caption: {
    input: (name: string) => `${name} in`,
    steered: "you steer",
    live: "live",
    styles,
    stylesOf: (n: number, database: string) => `${styles(n)} of ${database}`,
    parts: (n: number) => `${n === 1 ? "1 body part" : `${n} body parts`} styled separately`,
    keys: (n: number) => (n === 1 ? "1 key" : `${n} keys`),
    rate: (hz: number) => `${hz} Hz`,
  },
};
