import type { LessonText } from "../text";

export const judge: LessonText = {
  idea: [
    "Wie gut ist ein Verfahren, das einen alten Gang vorhersagt? Nimm eine Aufnahme aus der Datenbank, lass das Verfahren sie aus einem neutralen Gang vorhersagen und vergleiche das Ergebnis mit der Aufnahme. Das heißt Zurückhalten.",
    "Keine zwei Aufnahmen sind gleich, auch nicht von derselben Person. Also weicht auch eine andere echte Aufnahme desselben Stils ab; der senkrechte Strich zeigt, um wie viel. Ein Fehler darunter liegt in der Streuung echter Aufnahmen.",
    "Hier wird die Aufnahme „walk-pace“ in jedem Stil zurückgehalten. Ein mittlerer Fehler ist aber nur eine Zahl, und in dieser Lektion geht es darum, was sie verbirgt.",
  ],
  bet: {
    question:
      "KNN (k nächste Nachbarn) antwortet mit dem Mittel der nächsten Bilder, MAR (Mischung autoregressiver Modelle) legt Geraden hindurch. Bei zurückgehaltenen Aufnahmen vom Gehen: Um wie viel ist der mittlere Fehler von MAR kleiner?",
    options: {
      little: "Um weniger als 0,1 mm",
      some: "Um 0,1 bis 1 mm",
      much: "Um mehr als 1 mm",
    },
    reveal: ({ knn, mar, difference, other }) =>
      `Der Fehler von KNN ist ${knn} mm, der von MAR ${mar} mm: ${difference} mm Unterschied. Selbst die beste andere echte Aufnahme liegt um ${other} mm daneben. Beide liegen also in der Streuung echter Aufnahmen: Dieses Fehlermaß kann sie nicht unterscheiden.`,
  },
  look: [
    "Die Tabelle hat [e: den mittleren Fehler ē] jedes Verfahrens, über F Bilder und J Gelenke: alle außer der Hüfte, an der die beiden Körper ausgerichtet sind. Sie zeigt auch, wie [acceleration: rau] die Bewegung ist (ihre Beschleunigung im Verhältnis zur Eingabe), und wie viel [content: Inhalt] bleibt: die Korrelation r der schnellen Bewegungen von Eingabe und Ausgabe. Eine Spalte allein kann täuschen: GAR, eine Gerade für alle Bilder, ist am glattesten und hat den größten Fehler.",
    "Die Kurven sind [p: der Fehler] zweier Verfahren über der Zeit, der Abstand der vorhergesagten Gelenke p̂ von den aufgenommenen p. Die Fläche dazwischen hat die Farbe des besseren. Das Mittel zeigt, welches vorn liegt, die Kurven zeigen, [i: wann].",
    "KNN antwortet mit dem Mittel ȳ der Nachbarn. Die Antwort ŷ der Geraden weicht davon um Steigung mal Abstand ab: β sind die Steigungen, u ist die Eingabe und ū das Mittel der Eingaben der Nachbarn. Das Histogramm zählt [u: diesen Unterschied] über die ganze Aufnahme.",
    "Eine Auswertung ist nur ehrlich, wenn die Antwort nicht in der Datenbank war. Lässt du die Aufnahme drin, findet NN, das mit dem nächsten Bild antwortet, die Antwort dort.",
  ],
  symbols: {
    e: { symbol: "ē", name: "mittlerer Fehler des gewählten Verfahrens" },
    p: { symbol: "p̂ − p", name: "sein Fehler im Augenblick" },
    u: { symbol: "u − ū", name: "Eingabe minus Mittel der Nachbarn" },
    i: { symbol: "i", name: "Augenblick der Aufnahme" },
    acceleration: { symbol: "×", name: "Beschleunigung gegen die der Eingabe" },
    content: { symbol: "r", name: "Inhalt, der bleibt; 1 ist alles" },
  },
  why: "Warum liegt KNN fast gleichauf? Das Histogramm zeigt, was die Gerade zum Mittel der Nachbarn hinzufügt. Wie verhalten sich u und ū, wenn die Nachbarn rings um die Eingabe liegen?",
  exercises: {
    A: {
      task: "Der mittlere Fehler von MAR ist kleiner als der von KNN. Finde einen Augenblick, in dem MAR um mindestens 0,3 mm besser ist, und einen, in dem KNN es ist. Markiere beide.",
      pass: ({ pick, pickGain, rival, rivalGain }) =>
        `Ja: ${pick} ist an einer Marke um ${pickGain} mm besser, ${rival} an der anderen um ${rivalGain} mm. Ein Mittel verbirgt beides.`,
      near: {
        other: () => "Vergleiche MAR mit KNN auf walk-pace im Stil „alt“, zurückgehalten.",
        noPick: ({ pick }) => `Eine Marke für ${pick} fehlt noch.`,
        noRival: ({ rival }) => `Eine Marke für ${rival} fehlt noch.`,
        pick: ({ pick, pickGain }) => `Knapp: ${pick} ist an seiner Marke um ${pickGain} mm besser. Nötig sind 0,3 mm.`,
        rival: ({ rival, rivalGain }) =>
          `Knapp: ${rival} ist an seiner Marke um ${rivalGain} mm besser. Nötig sind 0,3 mm.`,
      },
      refuse: ({ pick, pickGain, rival, rivalGain }) =>
        `Die tiefere Kurve ist die bessere. An den Marken liegt ${pick} um ${pickGain} mm vorn und ${rival} um ${rivalGain} mm.`,
      no: ({ pick, pickGain, rival, rivalGain }) =>
        `An den Marken liegt ${pick} um ${pickGain} mm vorn und ${rival} um ${rivalGain} mm: Das reicht nicht für beide.`,
      hints: [
        "Ein Fehler ist ein Abstand: Die tiefere Kurve ist besser. Wer vorn liegt, wechselt in einem Schritt mehrmals.",
        "Suche Flächen in der Farbe der Kurve von KNN, zieh den Zeiger dorthin, dann nimm Umschalt und die Pfeiltasten.",
      ],
    },
    B: {
      task: "Lass walk-pace in der Datenbank und sieh zu, wie der Fehler von NN unter 1 mm fällt. Wähle dann, welche der zwei Zahlen von NN sagt, wie gut es vorhersagt.",
      pass: ({ out, in: left }) =>
        `Ja: ${out} mm. Die ${left} mm sagen nur, dass NN einen Gang wiederfindet, den es schon hat.`,
      near: {
        other: () => "Bleib bei walk-pace im Stil „alt“.",
        leave: () => "Lass die Aufnahme erst drin und lies den Fehler von NN.",
        tick: ({ in: left }) =>
          `Der Fehler von NN ist jetzt ${left} mm. Wähle die Zahl, die du veröffentlichen würdest.`,
      },
      refuse: ({ in: left }) => `NN hatte die Antwort gesehen. ${left} mm ist nachgeschlagen, nicht vorhergesagt.`,
      no: () => "Der Fehler von NN sollte kleiner als 1 mm sein: Wähle seine Aufnahme.",
      hints: [
        "Welche Bewegung willst du vorhersagen: eine, die schon in der Datenbank steht?",
        "Schalte „Drin lassen“ ein und vergleiche die Zeile von NN mit der von MAR: Welches Verfahren gewinnt am meisten, wenn es die Antwort gesehen hat?",
      ],
    },
    C: {
      task: "Nun Bewegungen anderer Sammlungen, die nicht in den Stilen aufgenommen wurden. Wähle unter den Verfahren mit einem Inhalt von mindestens 0,8 dasjenige, dessen Beschleunigung der der Eingabe am nächsten ist.",
      pass: ({ pick, acceleration, content }) =>
        `Ja: ${pick}, mit Beschleunigung ${acceleration} × und Inhalt ${content}: Von den Verfahren hier hat nur dieses den Bias aus Lektion 7. Beim aufgezeichneten Gehen waren die Fehler fast gleich; hier liegen die Verfahren weit auseinander.`,
      near: {
        other: () => "Wähle „andere Sammlungen“ als Quelle der Zahlen.",
        unmeasured: ({ pick }) => `${pick} wurde dort nicht gemessen. Wähle eines mit Zahlen.`,
      },
      refuse: ({ pick, content, acceleration }) =>
        `${pick} behält nur ${content} des Inhalts, bei ${acceleration} × Beschleunigung: Die Bewegung zittert und folgt der Eingabe nicht mehr.`,
      no: ({ pick, acceleration }) => `${pick} hat Beschleunigung ${acceleration} ×. Es gibt ein glatteres.`,
      hints: [
        "Ohne Aufnahme im Stil gibt es keinen Fehler. Achte auf das Zittern: 1 × ist so glatt wie die Eingabe.",
        "Die Linie in der Spalte der Beschleunigung steht bei 1 ×, die gepunktete in der des Inhalts bei 0,8. Welches Verfahren reicht über diese hinaus?",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitt 7: Vergleiche und Auswertung mit zurückgehaltenen Aufnahmen.",
    "Aufgezeichnete Zahlen sind die aus `docs/evaluation.md`, gelesen, als diese Seite gebaut wurde; `rust/strut-evaluation/src/leave_one_out.rs` berechnet sie, über ganze Gangzyklen. Live sind es alle Bilder einer Aufnahme, bevor Füße festgehalten werden.",
    "NN ist der nächste Nachbar, KNN das Mittel der nächsten, LAR eine lokale Gerade, MAR eine Mischung davon, GAR eine Gerade für alles, LTI ein lineares System, GP ein Gauß-Prozess. Das Histogramm ist das von [u: β⊤(u − ū)]: meist nahe 0, also gibt die Gerade dieselbe Antwort wie das Mittel.",
  ],
};
