import type { LessonText } from "../text";

export const time: LessonText = {
  idea: [
    "Ein Stil bestimmt nicht nur, wie sich ein Körper bewegt, sondern auch, wie schnell. Der alte Mensch braucht für jeden Schritt länger; nach ein paar Sekunden liegt er mehrere Schritte zurück.",
    "Darum sagt die Engine für jedes Bild zweierlei vorher: eine Pose, und wie lange sie dauert. Beides liest sie aus den Nachbarn ab, den nächsten Beispielen der Datenbank.",
    "Mischst du zwei Stile, werden Posen und Dauern gleich gemischt. Kannst du das Tempo ausrechnen, bevor du die Schritte siehst?",
  ],
  bet: {
    question: "Ganz alt dauert der Gang länger. Nimm halb alt und halb neutral: Wie viel der Verzögerung bleibt?",
    options: { less: "Weniger als die Hälfte", half: "Die Hälfte", more: "Mehr als die Hälfte" },
    reveal: ({ half, all, share }) =>
      `Ganz alt dauert ${all} % länger, halb alt ${half} %: ${share} der Verzögerung. Dauern werden mit denselben Gewichten gemischt wie Posen, also wächst die Verzögerung linear mit dem Gewicht.`,
  },
  look: [
    "Zieh den Punkt: Seine Position bestimmt die Gewichte [s: s] von alt und kindlich. Neutral erhält den Rest, sodass die Summe 1 ist. Im schraffierten Teil liegen Gewichte unter 0 oder über 1: Stile werden übertrieben.",
    "Die Kurve gibt zu jeder Zeit der Eingabe die Zeit der Mischung an; gestrichelt ist das Tempo der Eingabe. Die Steigung der Kurve ist die [w: Dauer w] eines Bildes, geteilt durch die 16,7 ms, die es in der Eingabe dauert.",
    "Die letzte Abbildung zeigt, woher die Dauer eines Stils kommt. Jeder Punkt ist ein Nachbar k im Abstand d, dessen Bild wₖ dauerte. Ein näherer Nachbar hat ein größeres [g: Gewicht gₖ]; wie schnell g fällt, bestimmt die [h: Bandbreite h], der mittlere Abstand aller K. vₖ ist das Gewicht aus Lektion 5. Das Mittel mit beiden Gewichten ist die waagrechte Linie.",
    "Die übrigen Zeilen mischen die Stile m: yᵐ ist die Pose eines Stils, wᵐ seine Dauer, und beide werden mit denselben Gewichten gemischt. Zuletzt korrigiert die Engine Bilder, bei denen die Nachbarn der Eingabe vorauslaufen oder hinter ihr zurückbleiben; darum ist w nicht genau ihr Mittel.",
  ],
  symbols: {
    w: { symbol: "w", name: "Dauer des Bildes" },
    g: { symbol: "gₖ", name: "Gewicht nach Abstand; die Summe Σ aller" },
    h: { symbol: "h", name: "Bandbreite: mittlerer Abstand, in σ" },
    s: { symbol: "sₘ", name: "Gewichte: alt, kindlich, neutral" },
  },
  why: "Wenn du nur Posen mischtest und das Tempo der Eingabe behieltest, wie sähe ein alter Gang aus? Und wenn du nur Dauern mischtest?",
  exercises: {
    A: {
      task: "Lass den Gang mit alt allein 1,2-mal so lang dauern wie die Eingabe, auf 0,005 genau.",
      pass: ({ old, ratio }) => `Ja: Mit ${old} alt dauert er ${ratio}-mal so lang.`,
      near: {
        other: () => "Nimm alt allein: Kindlich muss 0 sein.",
        more: ({ length }) => `Knapp: Länge jetzt ${length} s. Etwas mehr alt.`,
        less: ({ length }) => `Knapp: Länge jetzt ${length} s. Etwas weniger alt.`,
      },
      refuse: ({ old, ratio }) =>
        `${old} ist das Gewicht, nicht die Verzögerung: Ganz alt dauert viel weniger als doppelt so lang. Jetzt ist es das ${ratio}-Fache.`,
      no: ({ length, input }) => `Länge jetzt ${length} s, für ${input} s Eingabe.`,
      hints: [
        "Die Verzögerung ist linear im Gewicht: Lies sie beim Gewicht 1 ab, und nimm den Teil, den du brauchst.",
        "Beim Gewicht 1 steht der Faktor unter dem Bild. Teile 0,2 durch seinen Teil über 1.",
      ],
    },
    B: {
      task: "Alt ist langsamer, kindlich ist schneller. Nimm von beiden mindestens 0,25, im Dreieck, sodass der Gang so lang ist wie die Eingabe, auf 0,005 genau.",
      pass: ({ old, childlike, ratio }) =>
        `Ja: ${old} alt und ${childlike} kindlich heben sich auf: das ${ratio}-Fache.`,
      near: {
        motion: () => "Nimm den neutralen Gang.",
        other: () => "Von beiden mindestens 0,25, und kein Gewicht unter 0.",
        slow: ({ length }) => `Knapp: Länge jetzt ${length} s. Etwas zu langsam.`,
        fast: ({ length }) => `Knapp: Länge jetzt ${length} s. Etwas zu schnell.`,
      },
      refuse: ({ ratio }) =>
        `Gleiche Gewichte heben sich nicht auf: Alt bremst mehr, als kindlich beschleunigt. Jetzt ist es das ${ratio}-Fache.`,
      no: ({ length, input }) => `Länge jetzt ${length} s, für ${input} s Eingabe.`,
      hints: [
        "Lies die Verzögerung jedes Stils allein ab. Was der eine dazugibt, muss der andere wegnehmen.",
        "Stell alt auf etwas über 0,25, dann erhöhe kindlich, bis unter dem Bild 1,00 steht.",
      ],
    },
    C: {
      task: "Lass den Gang länger dauern als seine langsamste Aufnahme in irgendeinem Stil.",
      pass: ({ ratio, longest, longestStyle }) =>
        `Ja: das ${ratio}-Fache, und die langsamste Aufnahme, ${longestStyle}, dauerte das ${longest}-Fache. So langsam ist keine Aufnahme.`,
      near: {
        other: () => "Nimm den neutralen Gang.",
        further: ({ ratio, longest }) =>
          `Außerhalb der Daten, beim ${ratio}-Fachen. Es braucht mehr als ${longest}: weiter.`,
      },
      refuse: ({ ratio }) =>
        `Im Dreieck ist nichts langsamer als seine langsamste Ecke: jetzt das ${ratio}-Fache. Verlass das Dreieck.`,
      no: ({ ratio }) => `Jetzt ${ratio}-mal so lang.`,
      hints: [
        "Gewichte dürfen über 1 gehen: Dann wird neutral abgezogen.",
        "Zieh den Punkt nach rechts, in die Schraffur.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitte 5.1 und 5.4: Zeit, Interpolation und Extrapolation von Stilen.",
    "Die Dauern berechnet `rust/strut-core/src/transfer/timing.rs`, gemischt werden sie zusammen mit den Posen in `rust/strut-core/src/transfer/blend.rs`. Die Engine teilt jedes g durch das des nächsten Nachbarn, damit keines 0 wird, wo alle fern sind; im Mittel kürzt sich das.",
  ],
};
