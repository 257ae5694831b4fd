import type { LessonText } from "../text";

export const mix: LessonText = {
  idea: [
    "Die Datenbank hat vierzig Klassen: fünf Handlungen, jede in acht Stilen. Jede Klasse gibt eine Antwort aus ihrer eigenen Geraden. Welche Antwort zählt?",
    "Die Engine erfährt nicht, dass die Eingabe läuft. Sie misst, wie weit die Pose von den nächsten Beispielen jeder Klasse entfernt ist, und gibt näheren Klassen mehr Gewicht.",
    "Die Gewichte zeigen also auch, was die Engine erkennt: Hier läuft die Eingabe, geht, springt und geht wieder.",
  ],
  bet: {
    question:
      "Die Breite δ sagt, wie langsam ein Gewicht mit dem Abstand fällt. Verdopple sie: Gewinnt oder verliert die stärkste Klasse?",
    options: { gains: "Sie gewinnt", loses: "Sie verliert", same: "Nichts ändert sich" },
    reveal: ({ before, after }) =>
      `Ihr Gewicht geht von ${before} auf ${after}. Ein größeres δ toleriert Abstand: Die anderen Klassen holen auf, und weil alle Gewichte zusammen 1 sind, verliert die stärkste.`,
  },
  look: [
    "Die Flächen sind die [lambda: Gewichte λ] der Handlungen über der Zeit, alle Stile einer Handlung zusammen. Ihre Summe ist immer 1. Vor und nach den Sprüngen erkennt die Engine kurz einen Tritt: Dort steht die Eingabe still, wie vor einem Tritt.",
    "Die Liste zeigt die nächsten Klassen am Zeiger. [D: D] ist der mittlere quadrierte Abstand der nächsten Beispiele einer Klasse, in cm²; der Balken daneben ist das Gewicht, das daraus wird. Das Zeichen ∝ heißt „proportional zu“: Am Ende werden alle Gewichte durch ihre Summe geteilt.",
    "Die Kurve neben der Liste zeigt, wie das Gewicht mit dem Abstand fällt. Sie beginnt beim [min: kleinsten D], dem der nächsten Klasse. Über [delta: δ] mal min D fällt sie auf 1/e, etwa ein Drittel. Dreh an δ und beobachte die anderen Klassen.",
    "D wird durch min D geteilt, also zählen nur Verhältnisse: Wären alle Abstände doppelt so groß, blieben die Gewichte gleich. Das gilt, wo die Datenbank ähnliche Posen hat. Ist selbst die nächste Klasse mehrere Zentimeter entfernt, vergrößert die Engine δ; die Anzeige nennt dann beide Werte.",
    "Die zweite Zeile der Gleichung ist die Antwort, E(y): Jede Klasse j hat eine Gerade uᵀβ wie in Lektion 5, und deren Antworten werden mit diesen Gewichten gemittelt.",
  ],
  symbols: {
    lambda: { symbol: "λⱼ", name: "Gewicht einer Klasse; hier der zweiten" },
    D: { symbol: "Dⱼ", name: "mittlerer quadrierter Abstand derselben Klasse" },
    delta: { symbol: "δ", name: "Breite: wie langsam Gewicht fällt" },
    min: { symbol: "min D", name: "kleinstes D: das der nächsten Klasse" },
    t: { symbol: "t", name: "Augenblick der Eingabe" },
  },
  why: "Warum zählt das Verhältnis der Abstände und nicht ihr Unterschied? Vergleiche ein Bild, dessen zwei nächste Klassen bei 1 und 2 cm² liegen, mit einem, bei dem es 21 und 22 cm² sind.",
  exercises: {
    A: {
      task: "Wann wird aus Laufen Gehen? Finde den ersten Augenblick, in dem alle Klassen des Gehens zusammen mindestens so viel wiegen wie alle des Laufens.",
      pass: ({ secs, walk, run }) => `Ja: Bei ${secs} s hat Gehen ${walk} und Laufen ${run}.`,
      near: {
        other: () => "Lass die Eingabe und δ, wie sie waren: Nur der Zeiger soll sich bewegen.",
        later: ({ walk, run }) => `Knapp: Gehen hat ${walk}, Laufen ${run}. Etwas später.`,
        earlier: ({ walk, run }) => `Knapp: Gehen hat ${walk}, Laufen ${run}. Etwas früher.`,
      },
      refuse: ({ walk, run }) =>
        `Hier ist der Wechsel vorbei: Gehen hat ${walk}, Laufen ${run}. Gefragt ist, wann es wechselt.`,
      no: ({ secs, walk, run }) => `Bei ${secs} s hat Gehen ${walk} und Laufen ${run}.`,
      hints: [
        "Der Wechsel ist nicht plötzlich: Einige Bilder lang antworten beide, und die Ausgabe ist eine Mischung.",
        "Zieh den Zeiger dorthin, wo sich die Flächen von Laufen und Gehen bei der Hälfte treffen, dann nimm Umschalt und die Pfeiltasten.",
      ],
    },
    B: {
      task: "Wo der Zeiger steht, hat neutrales Laufen mehr als die Hälfte des Gewichts. Finde das δ, bei dem es die Hälfte hat.",
      pass: ({ delta, running }) => `Ja: Mit δ ${delta} hat neutrales Laufen ${running}.`,
      near: {
        other: () => "Lass die Eingabe, wie sie war, und den Zeiger, wo er war: Nur δ soll sich ändern.",
        more: ({ running }) => `Knapp: ${running}. Etwas mehr δ.`,
        less: ({ running }) => `Knapp: ${running}. Etwas weniger δ.`,
      },
      refuse: ({ delta, running }) =>
        `δ ist eine Breite und kein Gewicht: Mit δ ${delta} hat neutrales Laufen ${running}, nicht die Hälfte.`,
      no: ({ delta, running }) => `Mit δ ${delta} hat neutrales Laufen ${running}.`,
      hints: [
        "Ein größeres δ toleriert Abstand, und die stärkste Klasse verliert.",
        "Lies das Gewicht von Laufen / neutral in der Liste der nächsten Klassen, während du an δ drehst.",
      ],
    },
    C: {
      task: "Nimm die zwei nächsten Klassen allein, mit dem eingestellten δ. Berechne das Gewicht der ersten aus den zwei Abständen D und trage es ein.",
      pass: ({ alone, first, second }) => `Ja: ${first} und ${second} cm² ergeben ${alone}.`,
      near: {
        other: () => "Lass Eingabe, Augenblick und δ, wie sie waren. „Anfangen“ bringt sie zurück.",
        none: () => "Trage unter den Klassen eine Zahl von 0 bis 1 ein.",
        more: () => "Knapp. Es ist etwas mehr.",
        less: () => "Knapp. Es ist etwas weniger.",
      },
      refuse: ({ guess }) => `Das ist exp(−D): ${guess}. Teile erst beide D durch das kleinste und durch δ.`,
      no: ({ guess, first, second }) => `${guess} ist nicht das Gewicht zu ${first} und ${second} cm².`,
      hints: [
        "Teile zuerst durch das kleinste: Für die erste Klasse ist D / min D gleich 1.",
        "Zwei Terme: exp(−1/δ) und exp(−D₂/(δ D₁)). Das Gewicht ist der erste, geteilt durch ihre Summe.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Gl. 3–5: die Mischung autoregressiver Modelle.",
    "Die Gewichte berechnet `class_weights` in `rust/strut-core/src/transfer/class_weights.rs`. min D ist mindestens 1 mm². Gewichte unter zwei Hunderttausendsteln des größten fallen weg. δ ist bis zu dreimal so breit, wo die Eingabe unbekannt ist, und doppelt so breit, wo min D 25 cm² ist.",
  ],
};
