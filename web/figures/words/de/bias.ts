/** Figures of the bias in German. */
import type { Words } from "../words";

export const bias: Words["bias"] = {
  title: "Der Teil außerhalb des Bandes",
  stage: "Die gehobenen Arme, vorher und nachher",
  knobs: {
    raise: { symbol: "φ", name: "Heben φ, Grad", description: "Wie weit beide Arme der Eingabe gehoben sind" },
    reach: { symbol: "κ", name: "Reichweite κ", description: "Halbe Breite des Bandes, in Standardabweichungen" },
    keep: { symbol: "ρ", name: "Anteil ρ", description: "Anteil des Bias, der wieder addiert wird" },
  },
  axis: (joint) => `${joint}, Drehung von seinem Mittel, °`,
  input: "Eingabe",
  output: "Ausgabe",
  guess: "ρΔx, Grad",
  columns: ["Größe", "°"],
  rows: {
    x: "x, die Eingabe",
    mean: "μ, Mittel der Nachbarn",
    deviation: "σ der Nachbarn",
    bias: "Δx, der Bias",
    y: "y, die Ausgabe",
  },
  read: (low, high) => `Band von ${low}° bis ${high}°`,
  said: (x, low, high, bias, y) =>
    `Die Eingabe steht bei ${x}°, das Band reicht von ${low}° bis ${high}°: ${bias}° liegen außerhalb, und die Ausgabe steht bei ${y}°.`,
  elevations: ["Figur", "Oberarme gegen die Senkrechte, °"],
  posed: (style, time, raise) =>
    `Bei ${time} s: die Eingabe mit um ${raise}° gehobenen Armen, und ihre Fassung im Stil „${style}“.`,
};
