/** Figures of the evaluation in German. */
import type { Words } from "../words";

export const judge: Words["judge"] = {
  title: "Ergebnisse der Verfahren",
  methods: "Verfahren",
  names: { nn: "NN", knn: "KNN", lar: "LAR", mar: "MAR", gar: "GAR", lti: "LTI", gp: "GP" },
  columns: { pose: "Fehler ē, mm", acceleration: "Beschleunigung, × Eingabe", content: "Inhalt" },
  source: "Woher die Zahlen kommen",
  sources: { live: "diese Aufnahme, live", inside: "aufgezeichnetes Gehen", off: "andere Sammlungen" },
  leaveIn: "Drin lassen",
  honestOne: "Die ehrliche Zahl",
  honest: {
    "": () => "keine",
    out: (mm) => (mm === "" ? "zurückgehalten" : `zurückgehalten ${mm} mm`),
    in: (mm) => (mm === "" ? "drin" : `drin ${mm} mm`),
  },
  computing: "Die Verfahren werden berechnet.",
  where: (take, style, leftIn) => `${take} im Stil „${style}“, ${leftIn ? "drin gelassen" : "zurückgehalten"}`,
  achieved: (where, method, pose, acceleration, content) =>
    `${where}: ${method} hat Fehler ${pose} mm, Beschleunigung ${acceleration} × Eingabe, Inhalt ${content}.`,
  notMeasured: (where, method) => `${where}: ${method} wurde nicht gemessen.`,
  unchanged: "Eingabe unverändert",
  otherTake: "Strich: andere echte Aufnahme",
  otherTakeRecorded: "Strich: andere echte Aufnahme, aufgezeichnet",
  floor: (name, mm) => `${name} ${mm} mm`,
  noTruth: "Von diesen Bewegungen gibt es keine Aufnahme im Stil, also keinen messbaren Fehler.",
  duel: "Fehler über der Zeit",
  rival: "Verglichen mit",
  error: "Fehler, mm",
  pin: (method) => `Markieren: Hier ist ${method} besser`,
  duelled: (secs, pick, mm, rival, rivalMm, more) =>
    `Bei ${secs} s: ${pick} ${mm} mm, ${rival} ${rivalMm} mm, der Fehler von ${rival} ist um ${more} mm größer.`,
  duelMeans: (pick, mm, rival, rivalMm, more) => `ē: ${pick} ${mm} mm, ${rival} ${rivalMm} mm; hier ${more} mm`,
  corrections: "Die Antwort der Geraden minus das Mittel",
  correction: "β⊤(u − ū), °",
  instants: "Augenblicke",
  counting: (done, of) => `${done} von ${of} Augenblicken sind gezählt.`,
  counted: (joint, of, within, degrees, typical) =>
    `${joint}: in ${within} von ${of} Augenblicken höchstens ${degrees}° vom Mittel; die Hälfte höchstens ${typical}°.`,
  binColumns: ["β⊤(u − ū), °", "Augenblicke"],
};
