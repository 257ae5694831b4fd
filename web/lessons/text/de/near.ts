import type { LessonText } from "../text";

export const near: LessonText = {
  idea: [
    "Strut sucht in seinen Aufnahmen Momente, die der gegebenen Pose gleichen. Dafür braucht es eine Zahl, die misst, wie ähnlich sich zwei Momente sind.",
    "Es vergleicht die letzten fünf Bilder, Gelenk für Gelenk, und summiert quadrierte Abstände. Zwei Momente sind also nah, wenn sich Posen und Bewegung gleichen.",
    "Aber ist es etwas anderes, nach Norden zu gehen als nach Osten? Ein guter Abstand muss wissen, was er nicht beachten soll.",
  ],
  bet: {
    question: "Dreh die Figur um 90° und verschieb sie um 1 m. Wie ändert sich ihr Abstand zum nächsten Beispiel?",
    options: { same: "Er bleibt gleich", little: "Er wächst um einige Zentimeter", much: "Er wächst um viel mehr" },
    reveal: ({ before, after }) =>
      `Vorher: ${before} mm. Nachher: ${after} mm. Ein Fenster sind die letzten fünf Bilder. Bevor zwei Fenster verglichen werden, wird eines auf dem Boden dorthin gedreht und verschoben, wo es am besten passt.`,
  },
  look: [
    "Die undurchsichtige Figur ist die Anfrage, und p sind ihre Gelenke. Um sie stehen ihre 8 nächsten Beispiele; je näher eines ist, desto weniger durchsichtig. T bewegt die Gelenke p′ eines Beispiels dorthin, wo sie am besten passen: eine [theta: Drehung um θ] und eine Verschiebung um [x0: x₀] und [z0: z₀].",
    "Übrig bleiben Unterschiede in der [y: Höhe] und [z: am Boden], gewichtet danach, [w: wie groß und sichtbar jeder Teil ist]. Die acht sind so ähnlich, dass die Anfrage sie verdeckt: Zieh ein Glied an seinem Ring, und sieh, wie sie sich trennen und [D: D] wächst.",
    "Die zweite Zeile der Gleichung findet die beste Drehung und Verschiebung ohne Suche. Dabei sind y die Höhen und z die Positionen am Boden als komplexe Zahlen, minus ihr Mittel; beide sind mit √w multipliziert. Eine Drehung multipliziert z′ mit einer Zahl der Länge 1, und die beste macht das Produkt ⟨z, z′⟩ reell und positiv.",
    "Die Kurve ist [D: √D], ein Abstand in Millimetern, für jeden Moment einer Klasse (einer Handlung in einem Stil), die Punkte sind die [K: K nächsten]. Zieh jetzt den Ring am Boden: Die Anfrage bewegt sich, die Kurve nicht. Das Fenster hat [s: s Bilder] mit je 20 Gelenken.",
  ],
  symbols: {
    D: { symbol: "D", name: "mittlerer quadrierter Abstand; √D₁" },
    w: { symbol: "wᵢ", name: "größtes Gewicht eines Gelenks" },
    theta: { symbol: "θ", name: "Drehung des nächsten auf die Anfrage" },
    x0: { symbol: "x₀", name: "seine Verschiebung längs x" },
    z0: { symbol: "z₀", name: "seine Verschiebung längs z" },
    y: { symbol: "y", name: "Unterschied in der Höhe, letztes Bild" },
    z: { symbol: "z", name: "Unterschied am Boden, letztes Bild" },
    s: { symbol: "s", name: "Bilder eines Fensters" },
    K: { symbol: "K", name: "Zahl der Nachbarn; √D des letzten" },
  },
  why: "Der Abstand beachtet weder Position noch Richtung. Die Höhe beachtet er. Warum, und bei welchen Bewegungen ist das wichtig?",
  exercises: {
    A: {
      task: "Wie viele Nachbarn sind höchstens doppelt so weit entfernt wie der nächste? Stell K so ein, dass √D des letzten höchstens 2 √D₁ ist und ein weiterer darüber läge.",
      pass: ({ K, last, first }) => `Ja: Nummer ${K} ist ${last} mm entfernt, und 2 √D₁ ist zweimal ${first} mm.`,
      near: {
        other: () => "Nimm die Figur, wie sie am Anfang war: kein gebeugtes Glied, fünf Bilder, und die Zeit vorwärts.",
        more: ({ K, last }) => `Knapp: Nummer ${K} ist ${last} mm entfernt. Ein paar mehr passen noch.`,
        less: ({ K, last }) => `Knapp: Nummer ${K} ist ${last} mm entfernt. Das ist etwas zu weit.`,
      },
      refuse: ({ K }) => `Du hast D verglichen, das quadriert ist: Mit K ${K} verdoppelt sich D. Gefragt ist √D.`,
      no: ({ K, last, first }) => `Nummer ${K} ist ${last} mm entfernt. Die Grenze ist 2 × ${first} mm.`,
      hints: [
        "Lies √D₁ über der Kurve ab und verdopple es.",
        "Dreh den Knopf K, bis die gestrichelte Linie, √D von Nummer K, knapp darunter liegt. Pfeiltasten ändern K um eins.",
      ],
    },
    B: {
      task: "Dreh die Anfrage um mindestens 45° und verschieb sie um mindestens 0,5 m. Um wie viele Millimeter änderte sich √D₁? Trag es ein.",
      pass: ({ change }) => `Ja: Es änderte sich um ${change} mm. Position und Richtung gehören nicht zum Abstand.`,
      near: {
        other: () =>
          "Nur drehen und verschieben: Setz gebeugte Glieder zurück, nimm fünf Bilder und die Zeit vorwärts.",
        further: ({ heading, moved }) =>
          `Bis jetzt ist sie um ${heading}° gedreht und um ${moved} m verschoben. Geh weiter.`,
        none: () => "Trag jetzt die Änderung unter der Kurve ein.",
      },
      refuse: ({ guess, change }) =>
        `Du hast ${guess} mm eingetragen, aber √D₁ änderte sich um ${change} mm: Die beste Drehung und Verschiebung machen deine rückgängig.`,
      no: ({ guess }) => `${guess} mm ist nicht die Änderung.`,
      hints: [
        "Lies √D₁ über der Kurve vorher und nachher ab.",
        "Beobachte die Punkte der Kurve, während du die Anfrage verschiebst. Bewegen sie sich?",
      ],
    },
    C: {
      task: "Kehr die Zeit um, sodass die Figur rückwärtsgeht. Welches ist das kürzeste Fenster, in dem das nächste Beispiel mindestens 4-mal so weit entfernt ist wie mit der Zeit vorwärts?",
      pass: ({ window }) =>
        `Ja: ${window} Bilder zeigen eine Richtung, darum ist Rückwärtsgehen weit vom Vorwärtsgehen entfernt.`,
      near: {
        other: () => "Nimm die Figur, wie sie am Anfang war: Setz gebeugte Glieder zurück.",
        forward: () => "Kehr zuerst die Zeit um.",
        shorter: ({ window }) => `Mit ${window} Bildern ist es weit genug, aber ein kürzeres Fenster reicht auch.`,
      },
      refuse: () =>
        "Bei s = 1 sind es in beiden Richtungen dieselben Posen: Ein Bild hat keine Richtung, also ist √D₁ gleich.",
      no: ({ window }) => `${window} Bilder unterscheiden die beiden nicht.`,
      hints: [
        "Wie viele Bilder brauchst du, um die Richtung einer Bewegung zu sehen?",
        "Schalte „Zeit umkehren“ für jedes s ein und aus, und vergleiche √D₁.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Gl. 1. Die beste Drehung und Verschiebung haben eine geschlossene Form, siehe `docs/methods/search.md`.",
    "Abstände rechnet `rust/strut-core/src/search/metric.rs`, die Anfrage dieser Lektion `rust/strut-core/src/transfer/lens/query.rs`.",
  ],
};
