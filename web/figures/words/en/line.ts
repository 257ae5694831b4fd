/** Figures of one prediction in English. */
import type { LineWords, SweepWords } from "../line";

export const line: LineWords = {
  title: "One degree of freedom, and its line",
  knobs: {
    k: { symbol: "K", name: "Neighbours K", description: "How many of the nearest examples count" },
    lambda: { symbol: "λ", name: "Ridge λ", description: "How much a steep line costs" },
    noise: { symbol: "ν", name: "Noise ν, degrees", description: "Noise that is added to the targets" },
  },
  taper: "Nearer examples count more",
  input: (name) => `${name}, input`,
  output: (name, style) => `${name}, ${style}, °`,
  columns: ["row", "input x, °", "target y, °", "weight v"],
  read: (mean, above) => `mean ${mean}°, prediction ${above}° from it`,
  terms: "What each term adds to the prediction",
  termNames: { a: "a xₜ₋₁", b: "b yₜ₋₁", c: "c xₜ", d: "d", returned: "ρ Δx", y: "= yₜ" },
  termColumns: ["term", "coefficient", "adds, °"],
  adds: "angle from the mean of all rows, °",
  summed: (terms, y) => `The terms ${terms} sum to a prediction of ${y}.`,
  said: (name, k, x, y, slope, above) =>
    `${name}: ${k} examples; at an input of ${x}° the line predicts ${y}°, slope ${slope}, ${above}° from their mean.`,
};

export const sweep: SweepWords = {
  title: "Error over the ridge",
  error: "error, °",
  columns: ["λ", "error, °"],
  read: (error, least, best) => `error ${error}°; least ${least}° at λ ${best}`,
  said: (lambda, error, least, best) =>
    `At λ ${lambda} the prediction of the whole walk is off by ${error}°; the least is ${least}° at λ ${best}.`,
};
