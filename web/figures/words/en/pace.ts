/** Figures of the pace of a blend in English. */
export const pace = {
  blend: "Style weights",
  clock: "Time of the blend",
  paced: "The same second",
  votes: "How long the neighbours took",
  handle: "Blend",
  knobs: {
    old: { symbol: "s old", name: "Weight of old", description: "Share of the old style; beyond 1 it is exaggerated." },
    childlike: {
      symbol: "s child",
      name: "Weight of childlike",
      description: "Share of the childlike style; beyond 1 it is exaggerated.",
    },
  },
  input: "time of the input, s",
  output: "time of the output, s",
  distance: "distance d, in standard deviations σ",
  duration: "duration w of a frame, ms",
  weights: (old: string, childlike: string, neutral: string) =>
    `old ${old} · childlike ${childlike} · neutral ${neutral}`,
  read: (output: string, input: string, ratio: string) => `${output} s for ${input} s: ${ratio} times as long`,
  blended: (old: string, childlike: string, neutral: string, ratio: string) =>
    `With old ${old}, childlike ${childlike} and neutral ${neutral} the walk takes ${ratio} times as long.`,
  clocked: (time: string, output: string, length: string, ratio: string) =>
    `${time} s of the input correspond to ${output} s of the blend. The blend takes ${length} s, ${ratio} times as long.`,
  walking: (time: string, behind: string) => `At ${time} s the blend corresponds to the input at ${behind} s.`,
  ended: (time: string) => `At ${time} s the blend has ended.`,
  mean: (ms: string, bandwidth: string) => `w ${ms} ms · h ${bandwidth}`,
  voted: (style: string, count: string, ms: string, bandwidth: string) =>
    `In the style ${style}, ${count} neighbours predict that the frame lasts ${ms} ms; the bandwidth h is ${bandwidth}.`,
  blendName: "blend",
  shares: ["style", "weight"],
  times: ["input, s", "output, s"],
  voices: ["d", "w, ms", "g"],
} as const;
