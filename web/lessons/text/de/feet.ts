import type { LessonText } from "../text";

export const feet: LessonText = {
  idea: [
    "Eine vorhergesagte Pose stimmt auf einen Zentimeter, und doch siehst du sofort, wenn ein stehender Fuß rutscht. Das heißt Skate, und nichts sieht künstlicher aus.",
    "Das Bild ist die Sohle eines Fußes von oben, ein Umriss für jedes Bild eines Stands. Ein Fuß, der steht, sollte einen Umriss hinterlassen.",
    "Die Abhilfe hat drei Teile: wissen, ob ein Fuß steht, ihn halten, wo er ist, und das Knie so beugen, dass das Bein ihn erreicht.",
  ],
  bet: {
    question: "Das Halten ist aus. Wann rutscht ein stehender Fuß am schnellsten?",
    options: { strike: "Wenn er aufsetzt", middle: "Mitten im Stand", lift: "Wenn er abhebt" },
    reveal: ({ most, middle, held }) =>
      `Gleich nach dem Aufsetzen: ${most} cm/s, und ${middle} cm/s mitten im Stand. Ein Fuß, der eben noch schwang, gilt als stehend, bevor er ganz in Ruhe ist. Gehalten sind es ${held} cm/s.`,
  },
  look: [
    "In den grauen Abschnitten steht der Fuß. Er tut es ab [P: P] 0,6 und bis es unter 0,4 fällt: Die Punkte sind die [c: Stimmen der Nachbarn], die über die Zeit geglättet werden. Ein Fuß, der tief und langsam ist, steht sofort.",
    "Die dicke Kurve ist [q: das Rutschen], gestrichelt ist es mit der anderen Einstellung des Haltens. Stell den Abspielkopf auf einen [i: Augenblick], und schalte das Halten.",
    "Ein gehaltener Fuß wird um das berichtigt, was er gerutscht wäre, über drei Bilder. Dann ist die [d: Entfernung d] von der Hüfte zum Knöchel gegeben, und das Knie hat den [gamma: Winkel γ].",
  ],
  symbols: {
    P: { symbol: "P", name: "wie wahrscheinlich der Fuß steht" },
    c: { symbol: "c", name: "Stimmen der Nachbarn" },
    q: { symbol: "Δp", name: "Rutschen des Fußes, wie es das Halten lässt" },
    gamma: { symbol: "γ", name: "Winkel zwischen Ober- und Unterschenkel" },
    d: { symbol: "d", name: "von der Hüfte zum Knöchel" },
    i: { symbol: "t", name: "Augenblick" },
  },
  why: "Warum sind zwei Grenzen besser als eine: 0,6 zum Aufsetzen, 0,4 zum Lösen? Denk an ein P, das um 0,5 zittert.",
  exercises: {
    A: {
      task: "Mit ausgeschaltetem Halten: Geh auf 3 Bilder an den Augenblick heran, in dem der stehende linke Fuß am schnellsten rutscht.",
      pass: ({ speed, most }) => `Ja: ${speed} cm/s hier, und höchstens ${most} cm/s, beim Aufsetzen.`,
      near: {
        other: () => "Sieh auf den linken Fuß des alten Gangs, in diesem Abschnitt.",
        later: ({ speed }) => `Knapp: ${speed} cm/s. Etwas später.`,
        earlier: ({ speed }) => `Knapp: ${speed} cm/s. Etwas früher.`,
      },
      refuse: ({ speed }) =>
        `Ein gehobener Fuß darf sich bewegen, auch mit ${speed} cm/s. Bleib in den grauen Abschnitten.`,
      no: ({ speed }) => `Hier rutscht er mit ${speed} cm/s. Anderswo ist er schneller.`,
      hints: [
        "Nur wo der Fuß steht, zählt seine Geschwindigkeit: in den grauen Abschnitten.",
        "Sieh auf die Ränder der Abschnitte, und nimm Umschalt mit den Pfeiltasten für einzelne Bilder.",
      ],
    },
    B: {
      task: "Zieh den Knöchel, bis das Knie um 60° gebeugt ist, auf 1° genau.",
      pass: ({ d, bend }) => `Ja: Bei d ${d} m ist das Knie um ${bend}° gebeugt.`,
      near: {
        more: ({ bend }) => `Knapp: ${bend}°. Beug es etwas mehr.`,
        less: ({ bend }) => `Knapp: ${bend}°. Beug es etwas weniger.`,
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
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitt 6: Kontakte durch Abstimmung der nächsten Nachbarn. Der Artikel gewichtet Stimmen mit 1/D; die Engine danach, wie sich Höhen und Geschwindigkeiten der Füße gleichen.",
    "Stimmen zählt `rust/strut-core/src/transfer/contact_likelihood.rs`, Füße hält `rust/strut-core/src/transfer/footplant.rs`, und Knie löst `rust/strut-core/src/kinematics/two_bone_ik.rs`.",
  ],
};
