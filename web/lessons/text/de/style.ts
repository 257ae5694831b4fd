import type { LessonText } from "../text";

export const style: LessonText = {
  idea: [
    "Zwei Figuren gehen dieselben Schritte: links, rechts, links, in derselben Reihenfolge. Das ist der Inhalt.",
    "Die eine geht neutral, die andere wie ein alter Mensch: gebeugt und langsamer. Das ist der Stil.",
    "Um allein den Stil zu sehen, musst du gleiche Augenblicke des Schritts vergleichen. Aber welche sind gleich?",
  ],
  bet: {
    question:
      "Du kannst die beiden nach der Uhr paaren, Sekunde mit Sekunde, oder nach dem Schritt, Aufsetzen mit Aufsetzen. Welche Paarung zeigt mehr Unterschied zwischen den Posen?",
    options: { second: "Die gleiche Sekunde", content: "Der gleiche Inhalt" },
    reveal: ({ second, content }) =>
      `Im Mittel unterscheiden sich die Posen in der gleichen Sekunde um ${second} cm, bei gleichem Inhalt um ${content} cm. Der alte Gang ist langsamer: Nach einigen Sekunden steht die eine Figur auf dem linken Fuß, die andere auf dem rechten. Das ist ein Unterschied im Tempo, aber nach der Uhr zählt er als Unterschied der Pose.`,
  },
  look: [
    "Miss in jedem Augenblick i, wie weit jedes Gelenk der einen Figur vom selben Gelenk der anderen entfernt ist. Position und Richtung werden vorher entfernt. Das Mittel über die [J: J Gelenke] ist der [e: Unterschied e], in Zentimetern.",
    "Die [tau: Paarung τ] entscheidet, welcher Augenblick des Gangs im Stil mit i verglichen wird. Unter der Kurve führt ein Faden vom [i: Zeiger] zu diesem Augenblick.",
    "Zieh am Zeiger, ändere den Stil, und wechsle zwischen *gleiche Sekunde* und *gleicher Inhalt*. Je größer ein Punkt am Körper, desto weiter liegt dieses Gelenk bei den beiden auseinander.",
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
      },
      refuse: ({ style, meanContent, meanSecond }) =>
        `Du hast verschiedene Augenblicke des Schritts verglichen. Nach der Uhr hat ${style} den kleinsten Unterschied, ${meanSecond} cm; in gleichen Augenblicken sind es ${meanContent} cm.`,
      no: ({ style, meanContent }) => `${style} hat im Mittel ${meanContent} cm. Ein anderer Stil ist näher.`,
      hints: [
        "Auch Tempo ist Stil, aber es ist keine Pose. Paare gleiche Augenblicke.",
        "Stell *gleicher Inhalt* ein und lies das Mittel neben der Kurve dieses Namens.",
      ],
    },
    B: {
      task: "Finde im sexy Gang einen Augenblick, in dem der Unterschied in der gleichen Sekunde mindestens viermal so groß ist wie bei gleichem Inhalt.",
      pass: ({ secs, second, content }) => `Ja: Bei ${secs} s sind es ${second} cm gegen ${content} cm.`,
      near: {
        other: () => "Zeig den Stil „sexy“ für das neutrale Gehen, und das Mittel aller Gelenke.",
        later: ({ second, content }) => `Knapp: ${second} cm gegen ${content} cm. Geh etwas später.`,
        earlier: ({ second, content }) => `Knapp: ${second} cm gegen ${content} cm. Geh etwas früher.`,
      },
      refuse: () =>
        "Hier gehen beide im Gleichschritt: Die gleiche Sekunde ist der gleiche Inhalt. Such eine Stelle, an der sie es nicht tun.",
      no: ({ secs, second, content }) =>
        `Bei ${secs} s sind es ${second} cm gegen ${content} cm. Such einen größeren Abstand.`,
      hints: [
        "Der sexy Gang ist langsamer und bleibt zurück. Ist er einen Schritt zurück, steht er auf dem anderen Fuß; bei zwei Schritten gehen beide wieder im Gleichschritt.",
        "Achte auf die Beine: Wo die eine Figur den linken Fuß vorn hat und die andere den rechten, ist der Abstand am größten.",
      ],
    },
    C: {
      task: "Welches Gelenk verschiebt der alte Stil im Mittel am meisten? Wähle es in der Liste, oder klick auf seinen Punkt am Körper.",
      pass: ({ joint, jointMean }) => `Ja: ${joint}, im Mittel um ${jointMean} cm.`,
      near: {
        other: () => "Zeig den Stil „alt“ für das neutrale Gehen.",
        none: () => "Wähle ein Gelenk in der Liste über der Kurve, oder klick auf seinen Punkt am Körper.",
        close: ({ joint, jointMean }) =>
          `Knapp: ${joint}, ${jointMean} cm. Ein Gelenk in der Nähe verschiebt sich mehr.`,
      },
      refuse: ({ joint, jointMean, jointMeanSecond }) =>
        `Die Beine bewegen sich in jedem Gang am meisten, darum liegen sie nach der Uhr weit auseinander: ${joint} um ${jointMeanSecond} cm. Das ist Tempo. In gleichen Augenblicken sind es ${jointMean} cm.`,
      no: ({ joint, jointMean }) => `${joint}: im Mittel ${jointMean} cm. Ein anderes Gelenk verschiebt sich mehr.`,
      hints: [
        "Ein alter Mensch geht in der Hüfte gebeugt. Je höher ein Gelenk über ihr liegt, desto mehr verschiebt es sich.",
        "Stell *gleicher Inhalt* ein und such den größten Punkt am Körper.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, §1 und §4: was Stil ist, und wie Bewegungen gleichen Inhalts einander zugeordnet werden.",
    "Der Unterschied ist `meanDistance` in `web/player/measured.ts`; der Gang im Stil mit gleichem Inhalt ist `counterpart` in `rust/strut-demo/src/database.rs`.",
  ],
};
