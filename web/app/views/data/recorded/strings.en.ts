/** Texts of the dialog of recorded motions, which is loaded on demand. */
export const recordedWords = {
  heading: "Try recorded motion",
  what: "Single clips of data sets by other authors. The licence of each set says what you may do with its clips and with what you make of them. A clip is downloaded from the host of its set, and stored in this browser.",
  clipOf: (set: string) => `Clip of ${set}`,
  clips: "clips",
  clip: (action: string, style: string, take: number) => `${action}, ${style}${take > 0 ? ` ${take}` : ""}`,
  get: "Try",
  archive: (size: string) => `One archive of ${size}`,
  inData: "Get in Data",
  does: (what: string, set: string) => `${what}: ${set}`,
  fetching: (file: string) => `Downloading ${file}.`,
  offline: "There is no network connection. Clips that were downloaded before can still be opened.",
  close: "Close",
};
