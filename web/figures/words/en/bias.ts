/** Figures of the bias in English. */
export const bias = {
  title: "The part outside the band",
  stage: "The raised arms, before and after",
  knobs: {
    raise: { symbol: "φ", name: "Raise φ, degrees", description: "How far both arms of the input are raised" },
    reach: { symbol: "κ", name: "Reach κ", description: "Half the width of the band, in standard deviations" },
    keep: { symbol: "ρ", name: "Share ρ", description: "Share of the bias that is added back" },
  },
  axis: (joint: string) => `${joint}, turn from its mean, °`,
  input: "input",
  output: "output",
  guess: "ρΔx, degrees",
  columns: ["quantity", "°"],
  rows: {
    x: "x, the input",
    mean: "μ, mean of the neighbours",
    deviation: "σ of the neighbours",
    bias: "Δx, the bias",
    y: "y, the output",
  },
  read: (low: string, high: string) => `band from ${low}° to ${high}°`,
  said: (x: string, low: string, high: string, bias: string, y: string) =>
    `The input is at ${x}°, the band from ${low}° to ${high}°: ${bias}° are outside, and the output is at ${y}°.`,
  elevations: ["walker", "upper arms from straight down, °"],
  posed: (style: string, time: string, raise: string) =>
    `At ${time} s: the input with its arms raised by ${raise}°, and its ${style} version.`,
} as const;
