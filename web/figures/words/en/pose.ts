/** Figures of the degrees of freedom of a pose in English. */
export const pose = {
  stage: "Joint and mean",
  numbers: "The 67 numbers of this pose",
  title: "One number over time",
  knobs: {
    x: { symbol: "w x", name: "w about x", description: "Turns the joint from its mean about its x axis, degrees." },
    y: { symbol: "w y", name: "w about y", description: "Turns the joint from its mean about its y axis, degrees." },
    z: { symbol: "w z", name: "w about z", description: "Turns the joint from its mean about its z axis, degrees." },
    heading: {
      symbol: "turn",
      name: "Turn the walker",
      description: "Turns the whole walk about the vertical, degrees.",
    },
    phi: {
      symbol: "φ",
      name: "Own axes φ",
      description: "Turns the joint's own axes about x, degrees. They are a convention of each skeleton.",
    },
  },
  restore: "Put back",
  pose: "pose",
  angles: (joint: string) => `${joint}, °`,
  height: "h, m",
  sideways: "v to the left, m/s",
  forwards: "v forwards, m/s",
  turning: "ψ̇, °/s",
  time: "time, s",
  flexion: (joint: string) => `${joint}, about x, °`,
  raw: "log R",
  centred: "w",
  read: (angle: string) => `|w| ${angle}°`,
  counted: (changed: string, of: string) => `${changed} of ${of} changed`,
  jumps: (raw: string, jump: string) => `greatest jump: log R ${raw} rad · w ${jump} rad`,
  posed: (joint: string, angle: string, x: string, y: string, z: string) =>
    `The ${joint} is turned by ${angle}° from its mean: ${x}° about x, ${y}° about y, ${z}° about z.`,
  listed: (changed: string, of: string, heading: string, limbs: string) =>
    `With the walker turned by ${heading}° and ${limbs} ${limbs === "1" ? "limb" : "limbs"} bent, ${changed} of ${of} numbers differ from the input's.`,
  plotted: (joint: string, phi: string, raw: string, jump: string) =>
    `The ${joint} with its own axes turned by ${phi}°: from frame to frame log R jumps by ${raw} rad at most, w by ${jump} rad.`,
  components: ["joint", "x, °", "y, °", "z, °"],
  columns: ["time, s", "log R, °", "w, °"],
} as const;
