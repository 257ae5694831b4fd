/** Figures of one prediction in German. */
import type { Words } from "../words";

export const line: Words["line"] = {
  title: "Ein Freiheitsgrad und seine Gerade",
  knobs: {
    k: { symbol: "K", name: "Nachbarn K", description: "Wie viele der nächsten Beispiele zählen" },
    lambda: { symbol: "λ", name: "Ridge-Gewicht λ", description: "Wie viel eine steile Gerade kostet" },
    noise: { symbol: "ν", name: "Rauschen ν, Grad", description: "Rauschen, das zu den Zielen kommt" },
  },
  taper: "Nähere Beispiele zählen mehr",
  input: (name) => `${name}, Eingabe`,
  output: (name, style) => `${name}, ${style}, °`,
  columns: ["Zeile", "Eingabe x, °", "Ziel y, °", "Gewicht v"],
  read: (mean, above) => `Mittel ${mean}°, Vorhersage ${above}° davon`,
  terms: "Was jeder Term zur Vorhersage beiträgt",
  termNames: { a: "a xₜ₋₁", b: "b yₜ₋₁", c: "c xₜ", d: "d", returned: "ρ Δx", y: "= yₜ" },
  termColumns: ["Term", "Koeffizient", "trägt bei, °"],
  adds: "Winkel vom Mittel aller Zeilen, °",
  summed: (terms, y) => `Die Terme ${terms} ergeben zusammen eine Vorhersage von ${y}.`,
  said: (name, k, x, y, slope, above) =>
    `${name}: ${k} Beispiele; bei einer Eingabe von ${x}° sagt die Gerade ${y}° voraus, Steigung ${slope}, ${above}° vom Mittel.`,
};

export const sweep: Words["sweep"] = {
  title: "Fehler über λ",
  error: "Fehler, °",
  columns: ["λ", "Fehler, °"],
  read: (error, least, best) => `Fehler ${error}°; am kleinsten ${least}° bei λ ${best}`,
  said: (lambda, error, least, best) =>
    `Bei λ ${lambda} liegt die Vorhersage des ganzen Gangs um ${error}° daneben; am wenigsten sind es ${least}° bei λ ${best}.`,
};
