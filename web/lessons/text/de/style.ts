import type { LessonText } from "../text";

export const style: LessonText = {
  idea: [
    "Zwei Gehende machen dieselben Schritte: links, rechts, links, in derselben Reihenfolge. Das ist der Inhalt.",
    "Die eine Figur geht neutral, die andere wie ein alter Mensch: gebeugt, und langsamer. Das ist der Stil.",
    "Um allein den Stil zu sehen, muss man gleiche Augenblicke des Schritts vergleichen. Aber welche sind gleich?",
  ],
  bet: {
    question:
      "Man kann die beiden nach der Uhr paaren, Sekunde mit Sekunde, oder nach dem Schritt, Auftritt mit Auftritt. Welche Paarung zeigt mehr Unterschied zwischen den Posen?",
    options: { second: "Die gleiche Sekunde", content: "Der gleiche Inhalt" },
    reveal: ({ second, content }) =>
      `Im Mittel unterscheiden sich die Posen in der gleichen Sekunde um ${second} cm, bei gleichem Inhalt um ${content} cm. Der alte Gang ist langsamer: Nach einigen Sekunden steht die eine Figur auf dem linken Fuß, die andere auf dem rechten. Das ist Tempo, und die Uhr zählt es als Pose.`,
  },
  look: [
    "Miss in jedem Augenblick, wie weit jedes Gelenk von seinem Gegenstück entfernt ist, ohne Ort und Richtung des Gehens. Das Mittel aller Gelenke ist der [e: Unterschied e].",
    "Entscheidend ist die [tau: Paarung τ]: Sie nennt den Augenblick des Stils, der denselben Inhalt hat. In der Kurve führt ein Faden vom Zeiger zu diesem Augenblick.",
    "Zieh am Zeiger, ändere den Stil, und wechsle zwischen *gleiche Sekunde* und *gleicher Inhalt*. Je größer eine Marke am Körper, desto weiter ist das Gelenk entfernt.",
  ],
  symbols: {
    e: { symbol: "e", name: "Unterschied der Posen" },
    p: { symbol: "p", name: "Gelenke der neutralen Figur" },
    q: { symbol: "p′", name: "Gelenke der Figur im Stil" },
    tau: { symbol: "τ(i)", name: "Augenblick, mit dem i gepaart ist" },
    i: { symbol: "i", name: "Augenblick der Eingabe" },
    J: { symbol: "J", name: "Zahl der Gelenke" },
  },
  why: "Warum steigt und fällt die Kurve der gleichen Sekunde, während die des gleichen Inhalts fast eben bleibt?",
  exercises: {
    A: {
      task: "Welcher Stil ist dem neutralen am nächsten? Wähle den Stil mit dem kleinsten mittleren Unterschied.",
      pass: ({ style, meanContent }) => `Ja: ${style}, im Mittel ${meanContent} cm.`,
      near: {
        other: () => "Wähle einen anderen Stil als neutral, für das neutrale Gehen.",
        close: ({ style, meanContent }) => `Knapp: ${style} hat ${meanContent} cm. Ein Stil hat etwas weniger.`,
      },
      refuse: ({ style, meanContent, meanSecond }) =>
        `Du hast verschiedene Augenblicke des Schritts verglichen. Nach der Uhr hat ${style} am wenigsten, ${meanSecond} cm; in gleichen Augenblicken sind es ${meanContent} cm.`,
      no: ({ style, meanContent }) => `${style} hat im Mittel ${meanContent} cm. Es geht mit weniger.`,
      hints: [
        "Auch Tempo ist Stil, aber es ist keine Pose. Paare gleiche Augenblicke.",
        "Stelle *gleicher Inhalt* ein und lies das Mittel neben der Kurve dieses Namens.",
      ],
    },
    B: {
      task: "Finde im stolzen Gang einen Augenblick, in dem die gleiche Sekunde mindestens das Vierfache des gleichen Inhalts zeigt.",
      pass: ({ secs, second, content }) => `Ja: Bei ${secs} s sind es ${second} cm gegen ${content} cm.`,
      near: {
        other: () => "Wähle zuerst den Stil „stolz“.",
        later: ({ second, content }) => `Knapp: ${second} cm gegen ${content} cm. Geh etwas später.`,
        earlier: ({ second, content }) => `Knapp: ${second} cm gegen ${content} cm. Geh etwas früher.`,
      },
      refuse: () =>
        "Hier gehen beide im Gleichschritt: Die gleiche Sekunde ist der gleiche Inhalt. Such eine Stelle außer Tritt.",
      no: ({ secs, second, content }) =>
        `Bei ${secs} s sind es ${second} cm gegen ${content} cm. Such einen größeren Abstand.`,
      hints: [
        "Der stolze Gang ist langsamer. Je länger er dauert, desto weiter bleibt er zurück, bis zu einem halben Zyklus.",
        "Achte auf die Beine: Wo die eine Figur den linken Fuß vorn hat und die andere den rechten, ist der Abstand am größten.",
      ],
    },
    C: {
      task: "Welches Gelenk bewegt der alte Stil am meisten? Wähle es in der Liste, oder klick auf seine Marke.",
      pass: ({ joint, jointMean }) => `Ja: ${joint}, im Mittel um ${jointMean} cm.`,
      near: {
        other: () => "Wähle zuerst den Stil „alt“.",
        none: () => "Wähle ein Gelenk in der Liste über der Kurve, oder klick auf seine Marke am Körper.",
        close: ({ joint, jointMean }) => `Knapp: ${joint}, ${jointMean} cm. Ein Gelenk daneben bewegt sich mehr.`,
      },
      refuse: ({ joint, jointMean }) =>
        `Du hast verschiedene Augenblicke des Schritts verglichen. Beine bewegen sich in jedem Gang weit; in gleichen Augenblicken weicht ${joint} nur um ${jointMean} cm ab.`,
      no: ({ joint, jointMean }) => `${joint}: im Mittel ${jointMean} cm. Ein anderes Gelenk bewegt sich mehr.`,
      hints: [
        "Ein alter Mensch geht gebeugt. Was am weitesten von der Hüfte entfernt ist, bewegt sich am meisten.",
        "Such die größte Marke am Körper.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, §1 und §4: was Stil ist, und wie Bewegungen gleichen Inhalts einander zugeordnet werden.",
    "Der Unterschied ist `meanDistance` in `web/player/measured.ts`; der Gang im Stil mit gleichem Inhalt ist `counterpart` in `rust/strut-demo/src/database.rs`.",
  ],
};
