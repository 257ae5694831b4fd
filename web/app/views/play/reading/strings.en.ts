/** What the panel says that shows how a file was read. */
export const readingWords = {
  heading: "How this file was read",
  close: "Close",
  facts: (frames: string, rate: string) =>
    `${frames} frames at ${rate} Hz. Change a row and the character follows at once.`,
  reset: (row: string) => `${row}: as it was found`,
  resetAll: "Reset all",
  again: "The file was read again.",
  notes: "Notes",

  sources: { guessed: "guessed", measured: "measured", named: "by name", said: "as you said" },
  saidBefore: "Of an earlier file with this skeleton",
  saidNow: "In place of what was found",

  rows: {
    up: "Up axis",
    sides: "Sides",
    floor: "Floor",
    unit: "Unit",
    joints: "Joints",
  },
  axes: { y: "Y", "-y": "−Y", z: "Z", "-z": "−Z", x: "X", "-x": "−X" },
  up: { guessed: "From feet to head in this clip", measured: "The body stands along it" },
  sides: {
    named: "as named",
    exchanged: "exchanged",
    guessed: "As named, toes and knees pointed backwards",
    byName: "Left and right as the names say",
  },
  floor: {
    unit: "cm",
    name: "Floor, centimetres",
    measured: "Where the soles rest while planted",
    lowest: "No foot rests: the lowest sole",
  },
  unit: {
    metres: "metres",
    decimetres: "decimetres",
    centimetres: "centimetres",
    inches: "inches",
    millimetres: "millimetres",
    other: (centimetres: string) => `${centimetres} cm`,
    tall: (metres: string) => `So the body is ${metres} m tall`,
  },
  joints: {
    count: (found: number, all: number) => `${found} of ${all}`,
    edit: "Edit…",
    editWhy: "Choose which joint is which part of the body",
    export: "Export…",
    exportWhy: "Save the joints as a file, which strut takes with --joints",
    import: "Import…",
    importWhy: "Take the joints from such a file",
    ask: "Joints that you choose count for every file with this skeleton.",
    all: "All found by their names",
    some: (missing: string) => `Without a joint: ${missing}`,
    byShape: "Some by the shape of the skeleton",
    none: "No part of the body is without a joint",
    fileName: (input: string) => `${input} joints.json`,
    noJson: (name: string) => `“${name}” is no JSON file. Choose one that was exported here.`,
    noJoints: (name: string) => `“${name}” is no assignment of joints: {"joints": {"hips": "name", …}} was expected.`,
    noRole: (name: string, role: string) =>
      `“${name}” names the part “${role}”, which there is not. Parts have names such as left_hand.`,
  },

  remembered: "Remembered for every file with this skeleton.",
  willRemember: "Changes are remembered for this skeleton.",
  asBefore: "Read as you said of an earlier file with this skeleton.",
};
