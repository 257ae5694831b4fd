import type { LessonText } from "../text";

export const near: LessonText = {
  idea: [
    "Die Engine sucht in der Datenbank Momente, die dem gleichen, was du gerade tust. Dafür braucht sie eine Zahl, die sagt, wie ähnlich sich zwei Momente sind.",
    "Sie vergleicht die letzten fünf Bilder, Gelenk für Gelenk, und summiert quadrierte Abstände. Zwei Momente sind also nah, wenn die Posen sich gleichen und wenn es gleich weitergeht.",
    "Aber ist jemand, der nach Norden geht, anders als jemand, der nach Osten geht? Ein guter Abstand muss wissen, was er nicht beachtet.",
  ],
  bet: {
    question: "Dreh den Gehenden um 90° und verschieb ihn um 1 m. Was wird aus seinem Abstand zum nächsten Beispiel?",
    options: { same: "Er bleibt gleich", little: "Er wächst um einige Zentimeter", much: "Er wächst um viel mehr" },
    reveal: ({ before, after }) =>
      `Vorher: ${before} mm. Nachher: ${after} mm. Bevor zwei Fenster verglichen werden, wird eines auf dem Boden dorthin gedreht und verschoben, wo es am besten passt.`,
  },
  look: [
    "Um den Gehenden stehen seine 8 nächsten Beispiele, je näher, desto dichter. Jedes ist um [theta: θ gedreht] und um [x0: x₀] und [z0: z₀] dorthin verschoben, wo es am besten passt.",
    "Was bleibt, sind Unterschiede in der [y: Höhe] und [z: am Boden], gewichtet nach der [w: Größe jedes Gelenks]. Zieh ein Glied an seinem Ring und sieh [D: D] wachsen.",
    "Die Kurve ist [D: √D] für jeden Moment der Klasse, die Punkte sind die [K: K nächsten]. Zieh auch den Ring am Boden: Die Anfrage bewegt sich, die Kurve nicht.",
  ],
  symbols: {
    D: { symbol: "D", name: "quadrierter Abstand; √D zum nächsten" },
    w: { symbol: "wᵢ", name: "Gewicht eines Gelenks; das größte" },
    theta: { symbol: "θ", name: "Drehung des nächsten auf die Anfrage" },
    x0: { symbol: "x₀", name: "seine Verschiebung längs x" },
    z0: { symbol: "z₀", name: "seine Verschiebung längs z" },
    y: { symbol: "y − y′", name: "Rest in der Höhe, letztes Bild" },
    z: { symbol: "z", name: "Rest am Boden, letztes Bild" },
    s: { symbol: "s", name: "Bilder eines Fensters" },
    K: { symbol: "K", name: "Nachbarn; √D des letzten" },
  },
  why: "Der Abstand beachtet nicht, wo jemand ist und wohin er sieht. Die Höhe beachtet er. Warum, und bei welchen Bewegungen wäre das wichtig?",
  exercises: {
    A: {
      task: "Wie viele Nachbarn sind höchstens doppelt so weit wie der nächste? Stell K so ein, dass √D des letzten höchstens 2 √D₁ ist und einer mehr darüber läge.",
      pass: ({ K, last, first }) => `Ja: Nummer ${K} ist ${last} mm entfernt, und 2 √D₁ ist zweimal ${first} mm.`,
      near: {
        other: () => "Nimm den Gehenden, wie er war, fünf Bilder, und die Zeit vorwärts.",
        more: ({ K, last }) => `Knapp: Nummer ${K} ist ${last} mm entfernt. Ein paar mehr passen noch.`,
        less: ({ K, last }) => `Knapp: Nummer ${K} ist ${last} mm entfernt. Das ist etwas zu weit.`,
      },
      refuse: ({ K }) => `Du hast D verglichen, das quadriert ist: Mit K ${K} verdoppelt sich D. Gefragt ist √D.`,
      no: ({ K, last, first }) => `Nummer ${K} ist ${last} mm entfernt, der nächste ${first} mm.`,
      hints: [
        "Lies √D₁ unter der Kurve ab und verdopple es.",
        "Dreh K, bis die gestrichelte Linie, √D von Nummer K, knapp darunter liegt. Pfeiltasten ändern K um eins.",
      ],
    },
    B: {
      task: "Dreh die Anfrage um mindestens 45° und verschieb sie um mindestens 0,5 m. Um wie viele Millimeter änderte sich √D₁? Trag es ein.",
      pass: ({ change }) => `Ja: Es änderte sich um ${change} mm. Ort und Richtung gehören nicht zum Abstand.`,
      near: {
        other: () =>
          "Nur drehen und verschieben: Setz gebeugte Glieder zurück, nimm fünf Bilder und die Zeit vorwärts.",
        further: ({ heading, moved }) => `Sie ist um ${heading}° gedreht und um ${moved} m verschoben. Geh weiter.`,
        none: () => "Trag jetzt die Änderung unter der Kurve ein.",
      },
      refuse: ({ guess, change }) =>
        `Du hast ${guess} mm eingetragen, aber √D₁ änderte sich um ${change} mm: Die beste Drehung und Verschiebung nehmen deine wieder weg.`,
      no: ({ guess }) => `${guess} mm ist nicht die Änderung.`,
      hints: [
        "Lies √D₁ unter der Kurve vorher und nachher ab.",
        "Lass θ, x₀ und z₀ aufleuchten, während du schiebst: Sie nehmen die ganze Verschiebung auf.",
      ],
    },
    C: {
      task: "Kehr die Zeit um: Der Gehende geht rückwärts. Welches ist das kürzeste Fenster, in dem das nächste Beispiel mindestens 4-mal so weit ist wie mit der Zeit vorwärts?",
      pass: ({ window }) =>
        `Ja: ${window} Bilder haben eine Richtung, darum ist Rückwärtsgehen dem Vorwärtsgehen nicht nah.`,
      near: {
        other: () => "Nimm den Gehenden, wie er war: Setz gebeugte Glieder zurück.",
        forward: () => "Kehr zuerst die Zeit um.",
        shorter: ({ window }) => `Mit ${window} Bildern ist es weit genug, aber ein kürzeres Fenster reicht auch.`,
      },
      refuse: () => "Bei s = 1 sind beide dieselben Posen: Ein Bild hat keine Richtung.",
      no: ({ window }) => `${window} Bilder unterscheiden die beiden nicht.`,
      hints: ["Ein Bild hat keine Richtung.", "Schalte „Zeit umkehren“ für jedes s ein und aus, und vergleich √D₁."],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Gl. 1. Die beste Drehung und Verschiebung haben eine geschlossene Form, siehe `docs/methods/search.md`.",
    "Abstände rechnet `rust/strut-core/src/search/metric.rs`, die Anfrage dieser Lektion `rust/strut-core/src/transfer/lens/query.rs`.",
  ],
};
