/** Figures of the pace of a blend in German. */
import type { Words } from "../words";

export const pace: Words["pace"] = {
  blend: "Stilgewichte",
  clock: "Zeit der Mischung",
  paced: "Dieselbe Sekunde",
  votes: "Wie lange die Nachbarn brauchten",
  handle: "Mischung",
  knobs: {
    old: {
      symbol: "s alt",
      name: "Gewicht von alt",
      description: "Anteil des Stils „alt“; über 1 ist er übertrieben.",
    },
    childlike: {
      symbol: "s kindl.",
      name: "Gewicht von kindlich",
      description: "Anteil des Stils „kindlich“; über 1 ist er übertrieben.",
    },
  },
  input: "Zeit der Eingabe, s",
  output: "Zeit der Ausgabe, s",
  distance: "Abstand d, in Standardabweichungen σ",
  duration: "Dauer w eines Bildes, ms",
  weights: (old, childlike, neutral) => `alt ${old} · kindlich ${childlike} · neutral ${neutral}`,
  read: (output, input, ratio) => `${output} s für ${input} s: ${ratio}-mal so lang`,
  blended: (old, childlike, neutral, ratio) =>
    `Mit alt ${old}, kindlich ${childlike} und neutral ${neutral} dauert der Gang ${ratio}-mal so lang.`,
  clocked: (time, output, length, ratio) =>
    `${time} s der Eingabe entsprechen ${output} s der Mischung. Die Mischung dauert ${length} s, ${ratio}-mal so lang.`,
  walking: (time, behind) => `Bei ${time} s entspricht die Mischung der Eingabe bei ${behind} s.`,
  ended: (time) => `Bei ${time} s ist die Mischung zu Ende.`,
  mean: (ms, bandwidth) => `w ${ms} ms · h ${bandwidth}`,
  voted: (style, count, ms, bandwidth) =>
    `Im Stil „${style}“ sagen ${count} Nachbarn eine Dauer von ${ms} ms voraus; die Bandbreite h ist ${bandwidth}.`,
  blendName: "Mischung",
  shares: ["Stil", "Gewicht"],
  times: ["Eingabe, s", "Ausgabe, s"],
  voices: ["d", "w, ms", "g"],
};
