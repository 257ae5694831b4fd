/** Figures of a registered step in English. */
import type { WarpWords } from "../warp";

export const warp: WarpWords = {
  title: "Which instants correspond",
  paths: { linear: "linear", dtw: "DTW", imw: "IMW", own: "yours", exact: "true" },
  path: "Path at the cursor",
  neutral: "neutral step, ms",
  styled: (style) => `${style} step, ms`,
  anchor: (n) => `Bend ${n}`,
  place: (x, y) => `${x} ms with ${y} ms`,
  lead: ["cost", "· error"],
  cost: (ratio) => `${ratio} ×`,
  off: (ms) => `· ${ms} ms`,
  sides: ["L", "R"],
  feet: { both: "both feet", left: "the left foot", right: "the right foot", none: "no foot" },
  said: (path, time, tau, cost, neutral, style, feet) =>
    `Path ${path}: ${time} ms of the neutral step, on ${neutral}, with ${tau} ms of the ${style} one, on ${feet}. Difference c ${cost}.`,
  walkers: "The pair at the cursor",
  columns: ["style", "time, ms", "on the ground"],
  paired: (time, neutral, tau, style, feet) => `neutral ${time} ms: ${neutral}; ${style} ${tau} ms: ${feet}`,
};
