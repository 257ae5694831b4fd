import type { LessonText } from "../text";

export const line: LessonText = {
  idea: [
    "Wie weit beugt ein alter Mensch in diesem Augenblick das Knie? Kein Bild der Datenbank zeigt genau diese Pose. Aber einige Bilder sind nah, und zu jedem kennen wir das Bild des alten Gangs mit gleichem Inhalt.",
    "Trage einen Winkel über dem anderen auf: nach rechts das linke Knie der Eingabe (die Drehung seines Unterschenkels), nach oben das des alten Gangs. Jeder Punkt ist ein nahes Bild.",
    "Eine Gerade, an die Punkte angepasst, gibt die Antwort für Posen dazwischen. Jedes Gelenk hat seine eigene Gerade, und jedes Bild eine neue.",
  ],
  bet: {
    question: "Lege die Gerade durch den nächsten Punkt allein, K = 1. Welche Steigung hat sie?",
    options: {
      zero: "0: Sie liegt waagrecht",
      one: "1: Sie steigt wie die Eingabe",
      any: "Beliebig: Ein Punkt legt keine Steigung fest",
    },
    reveal: ({ slope }) =>
      `Sie ist ${slope}. Durch einen Punkt passt jede Steigung gleich gut. Der zweite Term der Gleichung bestraft steile Geraden, also gewinnt die waagrechte: Die Vorhersage ist der Punkt selbst.`,
  },
  look: [
    "Die Punkte sind die [K: K nächsten Bilder]; je größer ein Punkt, desto größer sein [v: Gewicht v]. Der Ring ist die [y: Antwort y]: Er liegt auf der Geraden, über der [x: Eingabe x]. Das Band zeigt den Fehler der ganzen Anpassung (mit allen drei Eingaben), eine Standardabweichung. Die Gerade ist nur ein Schnitt durch sie, darum können Punkte außerhalb liegen.",
    "[c: c] ist die Steigung der Geraden. Zwei weitere Terme, [a: a] und [b: b], gewichten Eingabe und Ausgabe des vorigen Bildes. [d: d] ist die Konstante, die bleibt, wenn alle drei 0 sind. Die untere Abbildung addiert die vier Terme.",
    "Die zweite Zeile legt die Anpassung fest. β fasst a, b und c zusammen. Für jeden Nachbarn k enthält u drei Zahlen: das vorige x, das vorige y und das jetzige x; y ist seine Ausgabe. Die Tilde heißt: minus das Mittel der Nachbarn. Der erste Term verlangt kleine Fehler.",
    "Der zweite Term bestraft Steigungen. V ist die Summe aller Gewichte und σ die Standardabweichung dieses Gelenks in der ganzen Datenbank; so passt dasselbe [lambda: Ridge-Gewicht λ] zu jedem K und jedem Gelenk. Drehst du λ auf, legt sich die Gerade auf das gepunktete Mittel, und d gibt die ganze Antwort.",
    "b bleibt zwischen −0,9 und 0,9. Ein Fehler in einem Bild geht, mit b multipliziert, in das nächste ein. Ist |b| < 1, klingt er ab.",
  ],
  symbols: {
    y: { symbol: "yₜ", name: "vorhergesagter Winkel der Ausgabe, vom Mittel aus" },
    x: { symbol: "xₜ", name: "Winkel der Eingabe, vom Mittel aus" },
    a: { symbol: "aₜ", name: "Gewicht der Eingabe ein Bild vorher" },
    b: { symbol: "bₜ", name: "Gewicht der Ausgabe ein Bild vorher" },
    c: { symbol: "cₜ", name: "Gewicht der Eingabe: die Steigung" },
    d: { symbol: "dₜ", name: "Konstante: die Antwort ohne Steigungen" },
    K: { symbol: "K", name: "Zahl der Nachbarn" },
    v: { symbol: "vₖ", name: "Gewicht eines Punkts, 0 bis 1; V ist ihre Summe" },
    lambda: { symbol: "λ", name: "Ridge-Gewicht: die Strafe für Steigung" },
  },
  why: "Warum darf die Engine eine Gerade anpassen, obwohl sich ein Knie nicht auf einer Geraden bewegt?",
  exercises: {
    A: {
      task: "Zwölf Punkte, alle mit gleichem Gewicht, mit 4° Rauschen. Sag den ganzen Gang vorher und vergleiche ihn mit dem aufgenommenen wütenden Gang: Finde ein λ, dessen Fehler höchstens 1 % über dem kleinsten liegt.",
      pass: ({ error, lambda }) => `Ja: λ ${lambda} ergibt ${error}°, und kein λ ist um mehr als 1 % besser.`,
      near: {
        other: () =>
          "Bleib beim Knie des wütenden Gangs, bei K 12, ν 4 und gleichen Gewichten: Nur λ soll sich ändern.",
        more: ({ error, leastError }) => `Knapp: ${error}°, am wenigsten sind ${leastError}°. Etwas mehr λ.`,
        less: ({ error, leastError }) => `Knapp: ${error}°, am wenigsten sind ${leastError}°. Etwas weniger λ.`,
      },
      refuse: ({ error, leastError }) =>
        `Die Gerade folgt dem Rauschen der 12 Punkte: ${error}°, wo ${leastError}° möglich sind.`,
      no: ({ error, leastError, left }) =>
        left === "mean"
          ? `Nur das Mittel ist übrig, und die Pose der Eingabe zählt nicht mehr: ${error}°, wo ${leastError}° möglich sind.`
          : `Zu viel λ: Die Gerade ist flacher als ihre Punkte. ${error}°, wo ${leastError}° möglich sind.`,
      hints: [
        "Mit kleinem λ folgt die Gerade dem Rauschen, mit großem beachtet sie die Eingabe nicht. Das beste liegt dazwischen.",
        "Achte auf die Gerade, während du an λ drehst: Sie soll weder steil sein noch waagrecht.",
      ],
    },
    B: {
      task: "Ohne Rauschen, mit 40 Nachbarn: Welches ist das kleinste λ, bei dem die Vorhersage höchstens 0,1° vom Mittel der Nachbarn abweicht? Bis zum 1,5-Fachen davon zählt noch.",
      pass: ({ lambda, above }) => `Ja: Bei λ ${lambda} liegt die Vorhersage ${above}° vom Mittel.`,
      near: {
        other: () =>
          "Lass Gelenk, Gewichte und Augenblick, wie sie waren, K bei 40 und ν bei 0: Nur λ soll sich ändern.",
        more: ({ above }) => `Knapp: noch ${above}° vom Mittel. Etwas mehr λ.`,
        less: ({ lambda, above }) => `Knapp: Bei λ ${lambda} sind es schon ${above}°. Etwas weniger genügt.`,
      },
      refuse: ({ lambda, above }) =>
        `Nur das Mittel ist übrig: λ ${lambda} ergibt ${above}°, aber viel weniger genügt.`,
      no: ({ lambda, above }) => `Bei λ ${lambda} liegt die Vorhersage noch ${above}° vom Mittel.`,
      hints: [
        "λ → ∞ lässt nur das Mittel übrig. Gesucht ist das λ, bei dem die Gerade es fast erreicht hat.",
        "Lies den Abstand vom Mittel unter dem Bild, und dreh λ mit Umschalt und den Pfeiltasten.",
      ],
    },
    C: {
      task: "Finde einen Augenblick, in dem die Antwort der Geraden um mindestens 2° vom Mittel abweicht. K und λ sind frei.",
      pass: ({ above, lambda, k }) => `Ja: ${above}° vom Mittel, mit K ${k} und λ ${lambda}.`,
      near: {
        other: () =>
          "Lass Gelenk und Gewichte, wie sie waren, und das Rauschen ν bei 0: Frei sind nur K, λ und der Augenblick.",
        close: ({ above }) =>
          `Knapp: ${above}°. Suche einen Augenblick, in dem die Punkte steiler steigen oder fallen.`,
      },
      refuse: ({ above }) =>
        `Nur das Mittel ist übrig: ${above}°. Eine steile Gerade braucht ein kleines λ und mehr als ein, zwei Punkte.`,
      no: ({ above }) => `${above}° vom Mittel. In anderen Augenblicken ist es mehr.`,
      hints: [
        "Weit vom Mittel heißt: eine steile Gerade, und eine Eingabe weit auf einer Seite ihrer Nachbarn.",
        "Drehe K auf 160 und λ weit herunter, dann geh mit dem Augenblick durch den Gang.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Gl. 2: ein lokales Modell für jeden Freiheitsgrad.",
    "Die Gerade wird von `predict` in `rust/strut-core/src/transfer/regression.rs` angepasst; die Gewichte sind die aus `rust/strut-core/src/transfer/coherence.rs`. Die Rückkopplung b ist auf ±0,9 begrenzt, damit keine Vorhersage davonläuft.",
    "Ist Aufgabe A gelöst, zeigt eine Kurve neben diesem Text den Fehler zu jedem λ: Zieh [lambda: λ] an ihr entlang.",
  ],
};
