/** Figures of a synthesised step in German. */
import type { Words } from "../words";

export const chain: Words["chain"] = {
  chain: "Die Zustände eines linken und eines rechten Schritts",
  path: "Der Verlauf durch die Zustände",
  gait: "Der Gang dieses Modells",
  knobs: {
    pose: { symbol: "σ² ×", name: "Varianz der Pose", description: "Multipliziert σ² jedes Zustands." },
    velocity: {
      symbol: "σ′² ×",
      name: "Varianz der Geschwindigkeit",
      description: "Multipliziert σ′² jedes Zustands.",
    },
    acceleration: {
      symbol: "σ″² ×",
      name: "Varianz der Beschleunigung",
      description: "Multipliziert σ″² jedes Zustands.",
    },
    left: {
      symbol: "ρ links",
      name: "ρ der linken Schritte",
      description: "Um wie viele Varianzen jeder Zustand länger dauert.",
    },
    right: {
      symbol: "ρ rechts",
      name: "ρ der rechten Schritte",
      description: "Um wie viele Varianzen jeder Zustand länger dauert.",
    },
    share: {
      symbol: "k",
      name: "Anteil k des Stils",
      description: "0 ist neutral, 1 der Stil; unter 0 ist er umgekehrt, über 1 übertrieben.",
    },
  },
  ends: { left: "Ende des linken Schritts", right: "Ende des rechten Schritts" },
  steps: { left: "linker Schritt", right: "rechter Schritt" },
  state: (n) => `Zustand ${n}`,
  time: "Zeit, s",
  angle: (joint) => `${joint}, um x, °`,
  read: (farthest, deviations, jerk) => `|c − μ| ≤ ${farthest}°, ${deviations} σ · Ruck ${jerk} ×`,
  walked: (left, right, cadence) => `links ${left} s · rechts ${right} s · ${cadence} Schritte in der Minute`,
  said: (joint, farthest, deviations, jerk) =>
    `${joint}: Die Kurve ist höchstens ${farthest}° von einem Mittel entfernt, ${deviations} Standardabweichungen, und ihr Ruck ist das ${jerk}-Fache der Kurve des Modells.`,
  walks: (style, share) => `Ein Gang mit einem Anteil von ${share} des Stils „${style}“; der Rest ist neutral.`,
  walker: "Gang",
  columns: ["Zeit, s", "μ, °", "σ, °", "c, °"],
  durations: ["Zustand", "links, s", "rechts, s"],
  shares: ["Stil", "k"],
};
