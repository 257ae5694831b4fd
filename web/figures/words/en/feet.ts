/** Figures of feet in English. */
export const feet = {
  title: "When a foot is planted, and how it slides",
  soles: "The sole from above",
  leg: "A leg from the side",
  foot: "Foot",
  sides: { left: "left foot", right: "right foot" },
  hold: "Hold planted feet",
  ankle: "Ankle",
  time: "time, s",
  speed: "slide, cm/s",
  likelihood: "P",
  across: "to the left, cm",
  along: "forwards, cm",
  forwards: "forwards, m",
  upwards: "from the hip, m",
  read: (speed: string, likelihood: string) => `slide ${speed} cm/s · P ${likelihood}`,
  slid: (cm: string) => `${cm} cm in this stance`,
  reached: (d: string, gamma: string) => `d ${d} m · γ ${gamma}°`,
  said: (time: string, foot: string, stands: boolean, speed: string, held: boolean) =>
    `At ${time} s the ${foot} ${stands ? "is planted" : "is lifted"} and moves at ${speed} cm/s, ${held ? "held" : "not held"}.`,
  seen: (foot: string, cm: string, held: boolean) =>
    `While the ${foot} is planted, ${held ? "held" : "not held"}, it slides by ${cm} cm.`,
  bent: (d: string, gamma: string, bend: string) =>
    `The ankle is ${d} m from the hip: the angle γ is ${gamma}°, so the knee is bent by ${bend}°.`,
  columns: ["time, s", "slide, cm/s", "P"],
  places: ["time, s", "forwards, cm", "to the left, cm"],
  parts: ["part", "value"],
  rows: { a: "thigh a, m", b: "shin b, m", d: "hip to ankle d, m", gamma: "angle γ, °" },
} as const;
