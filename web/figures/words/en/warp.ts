/** Figures of a registered step in English. */
export const warp = {
  title: "Which instants correspond",
  paths: { linear: "linear", dtw: "DTW", imw: "IMW", own: "yours", exact: "true" },
  path: "Path at the cursor",
  neutral: "neutral step, ms",
  styled: (style: string) => `${style} step, ms`,
  anchor: (n: number) => `Bend ${n}`,
  place: (x: string, y: string) => `${x} ms with ${y} ms`,
  lead: ["cost", "· error"],
  cost: (ratio: string) => `${ratio} ×`,
  off: (ms: string) => `· ${ms} ms`,
  sides: ["L", "R"],
  feet: { both: "both feet", left: "the left foot", right: "the right foot", none: "no foot" },
  said: (path: string, time: string, tau: string, cost: string, neutral: string, style: string, feet: string) =>
    `Path ${path}: ${time} ms of the neutral step, on ${neutral}, with ${tau} ms of the ${style} one, on ${feet}. Difference c ${cost}.`,
  walkers: "The pair at the cursor",
  columns: ["style", "time, ms", "on the ground"],
  paired: (time: string, neutral: string, tau: string, style: string, feet: string) =>
    `neutral ${time} ms: ${neutral}; ${style} ${tau} ms: ${feet}`,
} as const;
