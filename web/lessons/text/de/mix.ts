import type { LessonText } from "../text";

export const mix: LessonText = {
  idea: [
    "Die Datenbank hat vierzig Klassen: fünf Handlungen, jede in acht Stilen. Jede Klasse antwortet mit ihrer eigenen Geraden. Aber wessen Antwort zählt?",
    "Niemand sagt der Engine, dass die Eingabe läuft. Sie sieht nach, wie weit die Pose von den nächsten Beispielen jeder Klasse entfernt ist, und gibt näheren Klassen mehr Gewicht.",
    "Die Gewichte sind also zugleich das, als was die Engine die Eingabe liest: Hier läuft jemand, geht, springt und geht wieder.",
  ],
  bet: {
    question:
      "Die Breite δ sagt, wie langsam ein Gewicht mit der Entfernung fällt. Verdopple sie: Gewinnt oder verliert die stärkste Klasse?",
    options: { gains: "Sie gewinnt", loses: "Sie verliert", same: "Nichts ändert sich" },
    reveal: ({ before, after }) =>
      `Ihr Gewicht geht von ${before} auf ${after}. Ein größeres δ verzeiht Entfernung: Die Klassen dahinter holen auf, und weil alle Gewichte zusammen 1 sind, zahlt die stärkste.`,
  },
  look: [
    "Die Flächen sind die [lambda: Gewichte λ] der Handlungen über der Zeit, alle Stile einer Handlung zusammen. Zusammen sind sie immer 1.",
    "Die Liste hat die nächsten Klassen am Zeiger. [D: D] ist die mittlere quadrierte Entfernung der nächsten Beispiele einer Klasse; der Balken daneben ist das Gewicht, das daraus wird.",
    "Gewichte hängen nur vom Verhältnis zum [min: kleinsten D] ab: Wären alle Entfernungen doppelt so groß, änderte sich nichts. Dreh an [delta: δ] und beobachte die Klassen dahinter.",
  ],
  symbols: {
    lambda: { symbol: "λⱼ", name: "Gewicht der nächsten Klasse" },
    D: { symbol: "Dⱼ", name: "ihre Entfernung, quadriert" },
    delta: { symbol: "δ", name: "Breite" },
    min: { symbol: "min D", name: "kleinste Entfernung" },
    t: { symbol: "t", name: "Augenblick der Eingabe" },
  },
  why: "Warum zählt das Verhältnis der Entfernungen und nicht ihr Unterschied? Denk an eine Eingabe, der niemand in der Datenbank gleicht.",
  exercises: {
    A: {
      task: "Wann wird aus Laufen Gehen? Finde den ersten Augenblick, in dem alle Klassen des Gehens zusammen mindestens so viel wiegen wie alle des Laufens.",
      pass: ({ secs, walk, run }) => `Ja: Bei ${secs} s hat Gehen ${walk} und Laufen ${run}.`,
      near: {
        other: () => "Bleib bei der Eingabe, die erst läuft und dann geht.",
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
        other: () => "Lass den Zeiger, wo er war: Nur δ soll sich ändern.",
        more: ({ running }) => `Knapp: ${running}. Etwas mehr δ.`,
        less: ({ running }) => `Knapp: ${running}. Etwas weniger δ.`,
      },
      refuse: ({ delta, running }) =>
        `δ ist eine Breite und kein Gewicht: Mit δ ${delta} hat neutrales Laufen ${running}, nicht die Hälfte.`,
      no: ({ delta, running }) => `Mit δ ${delta} hat neutrales Laufen ${running}.`,
      hints: [
        "Ein breiteres δ verzeiht Entfernung, und die stärkste Klasse verliert.",
        "Lies das Gewicht von Laufen / neutral in der Liste der nächsten Klassen, während du an δ drehst.",
      ],
    },
    C: {
      task: "Nimm die zwei nächsten Klassen allein, mit dem eingestellten δ. Berechne das Gewicht der ersten aus den zwei Entfernungen und trage es ein.",
      pass: ({ alone, first, second }) => `Ja: ${first} und ${second} cm² ergeben ${alone}.`,
      near: {
        none: () => "Trage unter den Klassen eine Zahl von 0 bis 1 ein.",
        more: () => "Knapp. Es ist etwas mehr.",
        less: () => "Knapp. Es ist etwas weniger.",
      },
      refuse: ({ guess }) => `Das ist exp(−D): ${guess}. Teile erst beide Entfernungen durch die kleinste und durch δ.`,
      no: ({ guess, first, second }) => `${guess} ist nicht das Gewicht zu ${first} und ${second} cm².`,
      hints: [
        "Teile durch die kleinste: Die erste Klasse hat D / min D = 1.",
        "Zwei Terme: exp(−1/δ) und exp(−D₂/(δ D₁)). Das Gewicht ist der erste, geteilt durch ihre Summe.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Gl. 3–5: die Mischung autoregressiver Modelle.",
    "Die Gewichte berechnet `class_weights` in `rust/strut-core/src/transfer/mixture.rs`. Die kleinste Entfernung zählt mindestens als 1 mm², Anteile unter zwei Hunderttausendsteln des größten fallen weg, und δ ist bis zu dreimal so breit, wo die Eingabe unbekannt ist, ihr kleinstes D also über 25 cm².",
  ],
};
