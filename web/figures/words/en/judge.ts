/** Figures of the evaluation in English. */
import type { JudgeWords } from "../judge";

export const judge: JudgeWords = {
  title: "Results of the methods",
  methods: "Methods",
  names: { nn: "NN", knn: "KNN", lar: "LAR", mar: "MAR", gar: "GAR", lti: "LTI", gp: "GP" },
  columns: { pose: "error ē, mm", acceleration: "acceleration, × input", content: "content" },
  source: "Where the numbers come from",
  sources: { live: "this take, live", inside: "recorded walks", off: "other collections" },
  leaveIn: "Leave it in",
  honestOne: "The honest number",
  honest: {
    "": () => "not ticked",
    out: (mm) => (mm === "" ? "held out" : `held out ${mm} mm`),
    in: (mm) => (mm === "" ? "left in" : `left in ${mm} mm`),
  },
  computing: "Computing the methods.",
  where: (take, style, leftIn) => `${take} as ${style}, ${leftIn ? "left in" : "held out"}`,
  achieved: (where, method, pose, acceleration, content) =>
    `${where}: ${method} has error ${pose} mm, acceleration ${acceleration} × the input’s, content ${content}.`,
  notMeasured: (where, method) => `${where}: ${method} was not measured.`,
  unchanged: "input unchanged",
  otherTake: "line: another real take",
  otherTakeRecorded: "line: another real take, recorded",
  floor: (name, mm) => `${name} ${mm} mm`,
  noTruth: "These have no recording in the style, so no error can be measured.",
  duel: "Error over time",
  rival: "Compared with",
  error: "error, mm",
  pin: (method) => `Pin: ${method} is better here`,
  duelled: (secs, pick, mm, rival, rivalMm, more) =>
    `At ${secs} s: ${pick} ${mm} mm, ${rival} ${rivalMm} mm, the error of ${rival} is ${more} mm larger.`,
  duelMeans: (pick, mm, rival, rivalMm, more) => `ē: ${pick} ${mm} mm, ${rival} ${rivalMm} mm; here ${more} mm`,
  corrections: "The line’s answer minus the mean",
  correction: "β⊤(u − ū), °",
  instants: "instants",
  counting: (done, of) => `${done} of ${of} instants are counted.`,
  counted: (joint, of, within, degrees, typical) =>
    `${joint}: in ${within} of ${of} instants within ${degrees}° of the mean; half within ${typical}°.`,
  binColumns: ["β⊤(u − ū), °", "instants"],
};
