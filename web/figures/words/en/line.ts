/** Figures of one prediction in English. */
export const line = {
  title: "One degree of freedom, and its line",
  knobs: {
    k: { symbol: "K", name: "Neighbours K", description: "How many of the nearest examples count" },
    lambda: { symbol: "λ", name: "Ridge λ", description: "How much a steep line costs" },
    noise: { symbol: "ν", name: "Noise ν, degrees", description: "Noise that is added to the targets" },
  },
  taper: "Nearer examples count more",
  input: (name: string) => `${name}, input`,
  output: (name: string, style: string) => `${name}, ${style}, °`,
  columns: ["row", "input x, °", "target y, °", "weight v"],
  read: (mean: string, above: string) => `mean ${mean}°, prediction ${above}° from it`,
  terms: "What each term adds to the prediction",
  termNames: { a: "a xₜ₋₁", b: "b yₜ₋₁", c: "c xₜ", d: "d", returned: "ρ Δx", y: "= yₜ" },
  termColumns: ["term", "coefficient", "adds, °"],
  adds: "angle from the mean of all rows, °",
  summed: (terms: string, y: string) => `The terms ${terms} sum to a prediction of ${y}.`,
  said: (name: string, k: string, x: string, y: string, slope: string, above: string) =>
    `${name}: ${k} examples; at an input of ${x}° the line predicts ${y}°, slope ${slope}, ${above}° from their mean.`,
} as const;

export const sweep = {
  title: "Error over the ridge",
  error: "error, °",
  columns: ["λ", "error, °"],
  read: (error: string, least: string, best: string) => `error ${error}°; least ${least}° at λ ${best}`,
  said: (lambda: string, error: string, least: string, best: string) =>
    `At λ ${lambda} the prediction of the whole walk is off by ${error}°; the least is ${least}° at λ ${best}.`,
} as const;
