/** Figures of key-styling in English. */
/** A count with its noun. */
const counted = (count: string, noun: string) => `${count} ${noun}${count === "1" ? "" : "s"}`;

export const map = {
  som: "Components and their regions",
  learning: "Error after each pass",
  pad: "Drag the feet apart",
  posed: "The pose of these variables",
  update: "The sample, and the maps’ prediction",
  keys: "A cycle from keys",
  temperature: { symbol: "T", name: "Temperature T", description: "How softly components share in a pose." },
  steps: { one: "1 update", ten: "10", pass: "a pass", all: "all", restart: "Begin again" },
  printed: "Sign as printed",
  handle: "Style",
  key: (n: number) => `Key ${n}`,
  add: "Add a key",
  remove: "Remove a key",
  separation: "front-to-back distance of the feet, cm",
  height: "in height, cm",
  pass: "pass",
  error: "error, °",
  time: "time of the cycle, s",
  at: (updates: string, pass: string, error: string) =>
    `${counted(updates, "update")} · pass ${pass} · error ${error}°`,
  learned: (pass: string, error: string) => `pass ${pass}: ${error}°`,
  unlearned: "before the first pass",
  dragged: (change: string, error: string) => `greatest change ${change}° a frame · error ${error}°`,
  keyed: (count: string, error: string) => `${counted(count, "key")} · error ${error}°`,
  stepped: (updates: string, count: string, error: string) =>
    `After ${counted(updates, "update")} of ${count} components the error of this pass is ${error}°.`,
  fallen: (pass: string, error: string) => `After pass ${pass} the model is off by ${error}° on average.`,
  asked: (separation: string, height: string) =>
    `The feet are ${separation} cm apart front to back, and ${height} cm in height.`,
  interpolated: (count: string, error: string, from: string, to: string, worst: string) =>
    `With ${counted(count, "key")} the cycle is off by ${error}° on average, most between ${from} and ${to} s, by ${worst}°.`,
  pose: "pose",
  sampled: "sample x",
  predicted: "prediction Zv",
  predictedOff: (degrees: string) => `The prediction Zv is ${degrees}° from the sample x, averaged over the joints.`,
  noUpdate: "Make an update to show its sample here.",
  components: ["component", "share a", "r", "m, cm"],
  passes: ["pass", "error, °"],
  variables: ["variable", "cm"],
  frames: ["time, s", "distance, cm", "error, °"],
} as const;
