import type { LessonText } from "../text";

export const line: LessonText = {
  idea: [
    "Wie weit beugt ein alter Mensch in diesem Augenblick das Knie? Niemand in der Datenbank stand in genau dieser Pose. Aber einige Bilder sind nah, und zu jedem kennen wir das Bild des alten Gangs mit gleichem Inhalt.",
    "Trage einen Winkel über dem anderen auf: nach rechts das Knie der Eingabe, nach oben das alte Knie. Jeder Punkt ist ein nahes Bild.",
    "Eine Gerade durch die Punkte antwortet für Posen dazwischen. Jedes Gelenk hat seine eigene Gerade, und jedes Bild eine neue.",
  ],
  bet: {
    question: "Lege die Gerade durch den nächsten Punkt allein, K = 1. Welche Steigung hat sie?",
    options: {
      zero: "0: Sie liegt waagrecht",
      one: "1: Sie steigt wie die Eingabe",
      any: "Beliebig: Ein Punkt legt keine Steigung fest",
    },
    reveal: ({ slope }) =>
      `Sie ist ${slope}. Durch einen Punkt passt jede Steigung gleich gut. Der zweite Term der Gleichung lässt Steilheit etwas kosten, also gewinnt die billigste Gerade, und die ist waagrecht: Die Vorhersage ist der Punkt selbst.`,
  },
  look: [
    "Die Punkte sind die [K: K nächsten Bilder]; je größer ein Punkt, desto größer sein [v: Gewicht v]. Der Ring ist die Antwort: Er liegt auf der Geraden, über der [x: Eingabe x].",
    "Die Gerade ist für die Steigung [c: c] gezeichnet. Zwei weitere Terme, [a: a] und [b: b], wissen, wo Eingabe und Ausgabe ein Bild vorher standen. Sie schieben die Gerade auf und ab, während der Gang weitergeht.",
    "Das [lambda: λ der Ridge] macht Steigung teuer. Drehst du es auf, so legt sich die Gerade auf das gepunktete Mittel. Drehst du K auf, so streuen die Punkte: mehr Belege, aber von weniger ähnlichen Posen.",
  ],
  symbols: {
    y: { symbol: "yₜ", name: "vorhergesagter Winkel der Ausgabe" },
    x: { symbol: "xₜ", name: "Winkel der Eingabe" },
    a: { symbol: "aₜ", name: "Gewicht der Eingabe ein Bild vorher" },
    b: { symbol: "bₜ", name: "Gewicht der Ausgabe ein Bild vorher" },
    c: { symbol: "cₜ", name: "Gewicht der Eingabe: die Steigung" },
    d: { symbol: "dₜ", name: "wo die Gerade beginnt" },
    K: { symbol: "K", name: "Zahl der Nachbarn" },
    v: { symbol: "V", name: "Summe der Gewichte v der Nachbarn" },
    lambda: { symbol: "λ", name: "Gewicht der Ridge" },
  },
  why: "Warum darf die Engine eine Gerade anpassen, obwohl sich ein Knie nicht auf einer Geraden bewegt?",
  exercises: {
    A: {
      task: "Zwölf Punkte, alle gleich schwer, mit 4° Rauschen. Finde ein λ, dessen Vorhersage des ganzen Gangs so gut ist wie möglich: höchstens 1 % über dem kleinsten Fehler.",
      pass: ({ error, lambda }) => `Ja: λ ${lambda} ergibt ${error}°, und kein λ ist um mehr als 1 % besser.`,
      near: {
        other: () => "Lass K bei 12, ν bei 4 und alle Punkte gleich schwer.",
        more: ({ error, leastError }) => `Knapp: ${error}°, am wenigsten sind ${leastError}°. Etwas mehr λ.`,
        less: ({ error, leastError }) => `Knapp: ${error}°, am wenigsten sind ${leastError}°. Etwas weniger λ.`,
      },
      refuse: ({ error, leastError }) =>
        `Die Gerade folgt 12 Punkten samt ihrem Rauschen: ${error}°, wo ${leastError}° möglich sind.`,
      no: ({ error, leastError }) =>
        `Nur das Mittel ist übrig, und die Pose der Eingabe zählt nicht mehr: ${error}°, wo ${leastError}° möglich sind.`,
      hints: [
        "Ein kleines λ glaubt dem Rauschen, ein großes glaubt nichts. Das beste liegt dazwischen.",
        "Achte auf die Steigung c, während du λ drehst: Sie soll weder wild sein noch 0.",
      ],
    },
    B: {
      task: "Ohne Rauschen, mit 40 Nachbarn: Welches ist das kleinste λ, bei dem die Vorhersage höchstens 0,1° vom Mittel der Nachbarn abweicht? Um die Hälfte zu viel zählt noch.",
      pass: ({ lambda, above }) => `Ja: Bei λ ${lambda} liegt die Vorhersage ${above}° vom Mittel.`,
      near: {
        other: () => "Lass K bei 40, ν bei 0 und den Augenblick, wo er war.",
        more: ({ above }) => `Knapp: noch ${above}° vom Mittel. Etwas mehr λ.`,
        less: ({ lambda, above }) => `Knapp: Bei λ ${lambda} sind es schon ${above}°. Etwas weniger genügt.`,
      },
      refuse: ({ lambda, above }) =>
        `Nur das Mittel ist übrig: λ ${lambda} ergibt ${above}°, aber viel weniger genügt.`,
      no: ({ lambda, above }) => `Bei λ ${lambda} liegt die Vorhersage noch ${above}° vom Mittel.`,
      hints: [
        "λ → ∞ lässt nur das Mittel. Gesucht ist die Stelle, an der es fast schon übrig ist.",
        "Lies den Abstand vom Mittel unter dem Bild, und drehe λ mit Umschalt und den Pfeiltasten.",
      ],
    },
    C: {
      task: "Finde einen Augenblick, in dem die Gerade etwas anderes sagt als das Mittel: mindestens 2° davon. K und λ sind frei.",
      pass: ({ above, lambda, k }) => `Ja: ${above}° vom Mittel, mit K ${k} und λ ${lambda}.`,
      near: {
        other: () => "Setze das Rauschen ν auf 0: Die Gerade soll abweichen, nicht das Rauschen.",
        close: ({ above }) =>
          `Knapp: ${above}°. Suche einen Augenblick, in dem die Punkte steiler steigen oder fallen.`,
      },
      refuse: ({ above }) =>
        `Nur das Mittel ist übrig: ${above}°. Eine steile Gerade muss billig sein und braucht mehr als einen Punkt.`,
      no: ({ above }) => `${above}° vom Mittel. Es geht mehr.`,
      hints: [
        "Weit vom Mittel heißt: eine steile Gerade, und eine Eingabe weit auf einer Seite ihrer Nachbarn.",
        "Drehe K auf 160 und λ weit herunter, dann geh mit dem Augenblick durch den Gang.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Gl. 2: ein lokales Modell für jeden Freiheitsgrad.",
    "Die Gerade wird von `predict` in `rust/strut-core/src/transfer/regression.rs` angepasst; die Gewichte sind die aus `rust/strut-core/src/transfer/coherence.rs`. Die Rückkopplung b ist auf ±0,9 begrenzt, damit keine Vorhersage davonläuft.",
    "Die Kurve neben diesem Text ist der ganze Verlauf zu Aufgabe A: Zieh [lambda: λ] an ihr entlang.",
  ],
};
