/** Texts of the bar about a dropped input, which is loaded on demand. */
export const fileWords = {
  heading: "This file",
  facts: (secs: string, rate: string) => `${secs} s · ${rate} Hz`,
  howRead: "How it was read",
  trim: "Trim",
  from: "Trim from, seconds",
  to: "Trim to, seconds",
  between: "to",
  unit: "s",
  whole: "Whole clip",
  wholeWhy: "Play the whole clip (U)",
  trimmed: (from: string, to: string, kept: string) => `${from} to ${to} s, ${kept} s kept`,
  remove: "Remove",
  removeWhy: "Remove this file from the inputs",
  guesses: (n: number) => (n === 1 ? "1 guess" : `${n} guesses`),
};
