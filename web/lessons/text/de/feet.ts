import type { LessonText } from "../text";

export const feet: LessonText = {
  idea: [
    "Eine vorhergesagte Pose kann auf den Zentimeter stimmen und trotzdem falsch aussehen, sobald ein stehender Fuß rutscht. Auf Englisch heißt das Foot Skate.",
    "Die Abbildung zeigt die Sohle eines Fußes von oben: für jedes Bild eines Stands (der Zeit am Boden) eine Linie von der Ferse zum Ballen. Stünde der Fuß still, fielen alle Linien zusammen. Die rote ist der Fuß im gewählten Augenblick; die gestrichelte zeigt, wohin das Halten ihn bringt.",
    "Die Abhilfe hat drei Teile: erkennen, ob der Fuß steht, ihn an seiner Stelle halten und das Knie so beugen, dass das Bein ihn erreicht.",
  ],
  bet: {
    question: "Das Halten ist aus. Wann rutscht ein stehender Fuß am schnellsten?",
    options: { strike: "Wenn er aufsetzt", middle: "Mitten im Stand", lift: "Wenn er abhebt" },
    reveal: ({ most, middle, held, nth, frames }) =>
      `Dieser Stand hat ${frames} Bilder, und am schnellsten rutscht der Fuß in Bild ${nth}: mit ${most} cm/s, gegenüber ${middle} cm/s in der Mitte. Ein Fuß, der aufsetzt, gilt schon als stehend, kurz bevor er ruht. Gehalten rutscht er dort mit ${held} cm/s.`,
  },
  look: [
    "Steht der Fuß? Die 40 ähnlichsten Bilder der Datenbank stimmen ab: cₖ ist 1, wenn der Fuß in Bild k steht, sonst 0. Eine Stimme zählt umso mehr, je kleiner eₖ ist: wie sehr sich die Füße in Bild k von denen der Eingabe in Höhe und Geschwindigkeit unterscheiden. Jeder Punkt ist [c: das Ergebnis in einem Augenblick]. [P: P] ist dieses Ergebnis, mit den Kontakten des aufgenommenen Stils gemittelt und dann über die Zeit geglättet. Ab P 0,6 wird der Fuß gehalten, unter 0,4 gelöst, das sind die gepunkteten Linien; ein Fuß, der tief und langsam ist, gilt ohnehin als stehend. Wo er steht, ist das Diagramm grau.",
    "Die dicke Kurve ist [p: das Rutschen Δp] je Sekunde; gestrichelt ist das Rutschen mit der anderen Einstellung des Haltens. Stell den Zeiger auf einen [i: Augenblick], und schalte das Halten um: [q: Die Korrektur q] schiebt einen stehenden Fuß um die Strecke zurück, die er gerutscht ist. n zählt die Bilder, seit der Fuß steht, sodass das Halten über drei Bilder einsetzt.",
    "Nun steht fest, wo der Knöchel ist, und damit sein [d: Abstand d] von der Hüfte. Oberschenkel a, Unterschenkel b und d bilden ein Dreieck: Der Kosinussatz ergibt den [gamma: Winkel γ] im Knie.",
  ],
  symbols: {
    P: { symbol: "P", name: "wie wahrscheinlich der Fuß steht" },
    c: { symbol: "c", name: "Anteil der Stimmen fürs Stehen" },
    p: { symbol: "Δp", name: "Rutschen des Fußes" },
    q: { symbol: "q", name: "wie weit das Halten den Fuß verschiebt" },
    gamma: { symbol: "γ", name: "Winkel zwischen Ober- und Unterschenkel" },
    d: { symbol: "d", name: "von der Hüfte zum Knöchel" },
    i: { symbol: "t", name: "Augenblick" },
  },
  why: "Warum sind zwei Grenzen besser als eine: 0,6 zum Aufsetzen, 0,4 zum Lösen? Denk an ein P, das um 0,5 zittert.",
  exercises: {
    A: {
      task: "Das Halten ist aus. Stell den Zeiger im gezeigten Abschnitt auf den Augenblick, in dem der stehende linke Fuß am schnellsten rutscht, auf 3 Bilder genau.",
      pass: ({ speed, most }) => `Ja: ${speed} cm/s hier, und höchstens ${most} cm/s, dort, wo der Fuß aufsetzt.`,
      near: {
        other: () => "Sieh dir den linken Fuß des alten Gangs an, in diesem Abschnitt.",
        held: () => "Schalte zuerst das Halten aus: Gehalten bleibt der Fuß, wo er ist.",
        later: () => "Knapp, aber hier ist der Fuß noch in der Luft. Etwas später.",
        earlier: ({ speed }) => `Knapp: ${speed} cm/s. Etwas früher.`,
      },
      refuse: ({ speed }) =>
        `Ein gehobener Fuß darf sich bewegen, auch mit ${speed} cm/s. Sieh dort nach, wo er steht: wo es grau ist.`,
      no: ({ speed }) => `Hier rutscht er mit ${speed} cm/s. Anderswo ist er schneller.`,
      hints: [
        "Nur die Geschwindigkeit eines stehenden Fußes zählt: Sieh dir die grauen Abschnitte an.",
        "Sieh dir die Ränder der grauen Abschnitte an. Die Pfeiltasten bewegen den Zeiger, mit Umschalt um einzelne Bilder.",
      ],
    },
    B: {
      task: "Zieh den Knöchel, bis das Knie um 60° gebeugt ist, auf 1° genau.",
      pass: ({ d, bend }) => `Ja: Bei d ${d} m ist das Knie um ${bend}° gebeugt.`,
      near: {
        more: ({ bend }) => `Knapp: ${bend}°. Beuge es etwas mehr.`,
        less: ({ bend }) => `Knapp: ${bend}°. Beuge es etwas weniger.`,
      },
      refuse: ({ gamma, bend }) =>
        `γ ist ${gamma}°, der Winkel zwischen den Knochen. Ein gestrecktes Bein hat γ 180°: Dieses Knie ist um ${bend}° gebeugt.`,
      no: ({ bend }) => `Das Knie ist um ${bend}° gebeugt.`,
      hints: [
        "Ein gestrecktes Bein hat γ = 180°, also ist die Beugung 180° − γ.",
        "Du brauchst γ = 120°. Nur d zählt: Zieh den Knöchel zur Hüfte oder von ihr weg.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitt 6: Kontakte durch Abstimmung der nächsten Nachbarn. Der Artikel gewichtet Stimmen mit 1/D; die Engine danach, wie ähnlich sich die Füße in Höhe und Geschwindigkeit sind.",
    "Stimmen zählt `rust/strut-core/src/transfer/contact_likelihood.rs`, Füße hält `rust/strut-core/src/transfer/footplant.rs`, und Knie löst `rust/strut-core/src/kinematics/two_bone_ik.rs`.",
  ],
};
