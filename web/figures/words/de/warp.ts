/** Figures of a registered step in German. */
import type { Words } from "../words";

export const warp: Words["warp"] = {
  title: "Welche Augenblicke einander entsprechen",
  paths: { linear: "linear", dtw: "DTW", imw: "IMW", own: "deiner", exact: "wahr" },
  path: "Pfad am Zeiger",
  neutral: "neutraler Schritt, ms",
  styled: (style) => `Schritt „${style}“, ms`,
  anchor: (n) => `Knick ${n}`,
  place: (x, y) => `${x} ms mit ${y} ms`,
  lead: ["Kosten", "· Fehler"],
  cost: (ratio) => `${ratio} ×`,
  off: (ms) => `· ${ms} ms`,
  sides: ["L", "R"],
  feet: { both: "beide Füße", left: "linker Fuß", right: "rechter Fuß", none: "kein Fuß" },
  said: (path, time, tau, cost, neutral, style, feet) =>
    `Pfad ${path}: ${time} ms des neutralen Schritts (${neutral}) mit ${tau} ms im Stil „${style}“ (${feet}). Unterschied c ${cost}.`,
  walkers: "Das Paar am Zeiger",
  columns: ["Stil", "Zeit, ms", "am Boden"],
  paired: (time, neutral, tau, style, feet) => `neutral ${time} ms: ${neutral}; ${style} ${tau} ms: ${feet}`,
};
