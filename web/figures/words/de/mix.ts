/** Figures of the mixture in German. */
import type { Words } from "../words";

export const mix: Words["mix"] = {
  title: "Die nächsten Klassen",
  reading: "Als was die Eingabe erkannt wird",
  delta: { symbol: "δ", name: "Breite δ", description: "Wie langsam ein Gewicht mit dem Abstand fällt" },
  weight: "Gewicht λ",
  actions: { walk: "Gehen", run: "Laufen", jump: "Springen", punch: "Schlagen", kick: "Treten" },
  guess: "Gewicht der ersten von zweien",
  columns: ["Klasse", "D, cm²", "λ"],
  decay: "Gewicht über dem Abstand",
  distance: "Abstand D, cm²",
  span: "δ min D",
  least: "min D",
  here: (delta, here) => `${delta}, hier ${here}`,
  class: (name, square, weight) => `${name} bei ${square} cm², Gewicht ${weight}`,
  nearest: (classes) => `Die nächsten Klassen: ${classes}.`,
  readAs: (time, actions) => `Bei ${time} s: ${actions}.`,
};
