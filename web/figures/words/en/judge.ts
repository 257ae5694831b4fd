/** Figures of the evaluation in English. */
export const judge = {
  title: "Results of the methods",
  methods: "Methods",
  names: { nn: "NN", knn: "KNN", lar: "LAR", mar: "MAR", gar: "GAR", lti: "LTI", gp: "GP" },
  columns: { pose: "error ē, mm", acceleration: "acceleration, × input", content: "content" },
  source: "Where the numbers come from",
  sources: { live: "this take, live", inside: "recorded walks", off: "other collections" },
  leaveIn: "Leave it in",
  honestOne: "The honest number",
  /** With the error in mm, or empty if it is not known yet. */
  honest: {
    "": () => "not ticked",
    out: (mm: string) => (mm === "" ? "held out" : `held out ${mm} mm`),
    in: (mm: string) => (mm === "" ? "left in" : `left in ${mm} mm`),
  },
  computing: "Computing the methods.",
  where: (take: string, style: string, leftIn: boolean) => `${take} as ${style}, ${leftIn ? "left in" : "held out"}`,
  achieved: (where: string, method: string, pose: string, acceleration: string, content: string) =>
    `${where}: ${method} has error ${pose} mm, acceleration ${acceleration} × the input’s, content ${content}.`,
  notMeasured: (where: string, method: string) => `${where}: ${method} was not measured.`,
  unchanged: "input unchanged",
  otherTake: "line: another real take",
  otherTakeRecorded: "line: another real take, recorded",
  floor: (name: string, mm: string) => `${name} ${mm} mm`,
  noTruth: "These have no recording in the style, so no error can be measured.",
  duel: "Error over time",
  rival: "Compared with",
  error: "error, mm",
  pin: (method: string) => `Pin: ${method} is better here`,
  duelled: (secs: string, pick: string, mm: string, rival: string, rivalMm: string, more: string) =>
    `At ${secs} s: ${pick} ${mm} mm, ${rival} ${rivalMm} mm, the error of ${rival} is ${more} mm larger.`,
  duelMeans: (pick: string, mm: string, rival: string, rivalMm: string, more: string) =>
    `ē: ${pick} ${mm} mm, ${rival} ${rivalMm} mm; here ${more} mm`,
  corrections: "The line’s answer minus the mean",
  correction: "β⊤(u − ū), °",
  instants: "instants",
  counting: (done: string, of: string) => `${done} of ${of} instants are counted.`,
  counted: (joint: string, of: string, within: string, degrees: string, typical: string) =>
    `${joint}: in ${within} of ${of} instants within ${degrees}° of the mean; half within ${typical}°.`,
  binColumns: ["β⊤(u − ū), °", "instants"],
} as const;
