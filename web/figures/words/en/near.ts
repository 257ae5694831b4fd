/** Figures of the distance of windows in English. */
export const near = {
  stage: "The query and its 8 nearest",
  title: "Distance to every window",
  knobs: {
    heading: { symbol: "turn", name: "Turn", description: "Turns the whole query about the vertical, degrees." },
    x: { symbol: "x", name: "Move x", description: "Moves the whole query along x on the ground, metres." },
    z: { symbol: "z", name: "Move z", description: "Moves the whole query along z on the ground, metres." },
    k: { symbol: "K", name: "Neighbours K", description: "How many of the nearest windows are used." },
  },
  move: "Position of the query",
  moved: (x: string, z: string) => `x ${x} m, z ${z} m`,
  restore: "Put back",
  window: "Frames s of a window",
  reversed: "Reverse time",
  guess: "√D₁ changed by, mm",
  query: "query",
  rows: "time of the example, s",
  distance: "√D, mm",
  read: (first: string, k: string, last: string) => `√D₁ ${first} mm · √D of number ${k}: ${last} mm`,
  said: (window: string, reversed: boolean, first: string, k: string, last: string) =>
    `Windows of ${window} ${window === "1" ? "frame" : "frames"}${reversed ? ", the query’s time reversed" : ""}: the nearest is ${first} mm away, number ${k} is ${last} mm away.`,
  posed: (heading: string, x: string, z: string, limbs: string, first: string) =>
    `The query is turned by ${heading}° and moved by ${x} m and ${z} m, with ${limbs} ${limbs === "1" ? "limb" : "limbs"} bent. The nearest example is ${first} mm away.`,
  columns: ["row", "√D, mm", "θ"],
} as const;
