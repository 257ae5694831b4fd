/** Figures of a synthesised step in English. */
export const chain = {
  chain: "The states of a left and a right step",
  path: "The trajectory through the states",
  gait: "The walker of this model",
  knobs: {
    pose: { symbol: "σ² ×", name: "Variance of the pose", description: "Multiplies σ² of every state." },
    velocity: { symbol: "σ′² ×", name: "Variance of the velocity", description: "Multiplies σ′² of every state." },
    acceleration: {
      symbol: "σ″² ×",
      name: "Variance of the acceleration",
      description: "Multiplies σ″² of every state.",
    },
    left: { symbol: "ρ left", name: "ρ of left steps", description: "How many variances longer each state lasts." },
    right: { symbol: "ρ right", name: "ρ of right steps", description: "How many variances longer each state lasts." },
    share: {
      symbol: "k",
      name: "Share k of the style",
      description: "0 is neutral, 1 the style; below 0 it is reversed, above 1 exaggerated.",
    },
  },
  ends: { left: "End of the left step", right: "End of the right step" },
  steps: { left: "left step", right: "right step" },
  state: (n: number) => `state ${n}`,
  time: "time, s",
  angle: (joint: string) => `${joint}, about x, °`,
  read: (farthest: string, deviations: string, jerk: string) =>
    `|c − μ| ≤ ${farthest}°, ${deviations} σ · jerk ${jerk} ×`,
  walked: (left: string, right: string, cadence: string) =>
    `left ${left} s · right ${right} s · ${cadence} steps a minute`,
  said: (joint: string, farthest: string, deviations: string, jerk: string) =>
    `The ${joint}: the curve is ${farthest}° from a mean at most, ${deviations} standard deviations, and its jerk is ${jerk} times that of the model.`,
  walks: (style: string, share: string) =>
    `A walk with a share of ${share} of the style ${style}; the rest is neutral.`,
  walker: "walk",
  columns: ["time, s", "μ, °", "σ, °", "c, °"],
  durations: ["state", "left, s", "right, s"],
  shares: ["style", "k"],
} as const;
