import type { LessonText } from "../text";

export const pose: LessonText = {
  idea: [
    "Um eine Pose vorherzusagen, musst du sie als Zahlen schreiben. Jedes Gelenk hat eine Drehung gegenüber seinem Elterngelenk. Eine Drehung ist eine Achse und ein Winkel.",
    "Multipliziere die Achse, einen Vektor der Länge 1, mit dem Winkel, und du hast drei Zahlen. Sie werden von der mittleren Drehung des Gelenks aus gemessen: Gelenke drehen sich selten weit von ihrem Mittel weg, also bleiben die Zahlen klein.",
    "Zwanzig Gelenke und die Neigung der Hüfte ergeben 21 · 3 = 63 Zahlen. Vier weitere geben die Höhe der Hüfte an und wie schnell sich die Figur bewegt und dreht. Jede dieser Zahlen heißt Freiheitsgrad.",
  ],
  bet: {
    question: "Dreh die Figur um 90°. Wie viele der 67 Zahlen ihrer Pose ändern sich?",
    options: { none: "Keine", few: "Ein paar: die der Hüfte", all: "Fast alle" },
    reveal: ({ changed, of, turn }) =>
      `${changed} von ${of} ändern sich, wenn sich die Figur um ${turn}° dreht. Position und Richtung gehören nicht zur Pose: Geschwindigkeiten sind relativ zur Figur, und die Neigung der Hüfte wird ohne die Richtung gemessen.`,
  },
  look: [
    "Der Pfeil ist [w: w]. Seine Richtung ist die Achse, um die das Gelenk gegenüber [mean: seinem Mittel R̄] gedreht ist, das du als durchscheinende Schattenfigur siehst. Seine Länge ist der Winkel. Der farbige Fächer zeigt denselben Winkel, vom Mittel bis zur [R: Drehung R des Gelenks].",
    "Der Logarithmus log macht aus einer Drehung Achse mal Winkel. Von den zwei Drehrichtungen nimmt er die kürzere, also ist der Winkel ‖w‖ nie größer als π, eine halbe Drehung. Der Vektor x ist die ganze Pose.",
    "Zieh ein Glied an seinem Ring, oder stell die drei Komponenten von w ein. Nur die drei Zahlen dieses Gelenks ändern sich.",
    "Die letzten vier Zahlen sind die [h: Höhe h der Hüfte], ihre [v: Geschwindigkeit v] nach links und vorwärts, und [psi: wie schnell sich die Richtung dreht, ψ̇].",
  ],
  symbols: {
    w: { symbol: "wⱼ", name: "Achse mal Winkel, vom Mittel aus; Winkel" },
    mean: { symbol: "R̄ⱼ", name: "mittlere Drehung des Gelenks; Winkel" },
    R: { symbol: "Rⱼ", name: "Drehung des Gelenks; Winkel" },
    h: { symbol: "h", name: "Höhe der Hüfte" },
    v: { symbol: "v", name: "Geschwindigkeit nach links und vorwärts" },
    psi: { symbol: "ψ̇", name: "wie schnell sich die Richtung dreht" },
  },
  why: "Winkel von 179° und −179° sind fast dieselbe Drehung, aber als Zahlen weit auseinander. Warum ist das schlecht für eine Vorhersage, wenn sich ein Gelenk dort bewegt, und wie hilft das Mittel?",
  exercises: {
    A: {
      task: "Die x-, y- und z-Achse eines Gelenks sind Konvention. Dreh die Achsen des linken Oberschenkels um φ, bis log R, ohne das Mittel berechnet, von einem Bild zum nächsten um mehr als 1,5 rad (86°) springt.",
      pass: ({ phi, rawJump, jump }) =>
        `Ja: Bei φ ${phi}° springt log R um ${rawJump} rad, w nie um mehr als ${jump} rad. φ dreht R und R̄ gleich, also bleibt der Winkel zwischen ihnen derselbe.`,
      near: {
        other: () =>
          "Nimm den linken Oberschenkel beim neutralen Gehen, ohne gebeugtes Glied und ohne die Figur zu drehen.",
        further: ({ phi }) => `Knapp: Bei φ ${phi}° sind beide noch glatt. Etwas weiter.`,
      },
      refuse: ({ phi }) => `Beide sind glatt bei φ ${phi}°: Dreh weiter.`,
      no: ({ rawJump }) => `log R springt um ${rawJump} rad.`,
      hints: [
        "Ein Winkel von 180° ist die Grenze: Dahinter ist die andere Drehrichtung kürzer, und die Achse klappt um.",
        "Sieh die Kurve von log R an: Das Schwingen des Oberschenkels kommt zu φ dazu. Dreh φ, bis die Kurve 180° erreicht.",
      ],
    },
    B: {
      task: "Bring das linke Knie in diesem Augenblick in sein Mittel: Dreh den Unterschenkel bis auf 3° an den der Schattenfigur heran.",
      pass: ({ angle }) => `Ja: |w| ist ${angle}°. In seinem Mittel sind alle drei Zahlen eines Gelenks fast 0.`,
      near: {
        other: () =>
          "Nimm den linken Unterschenkel beim neutralen Gehen, in dem Augenblick, in dem die Aufgabe begann.",
        bend: ({ angle }) => `Knapp: ${angle}°. Beuge es etwas mehr.`,
        stretch: ({ angle }) => `Knapp: ${angle}°. Strecke es etwas.`,
        aside: ({ angle }) => `Knapp: ${angle}°. Es ist zur Seite gedreht: Bring w y und w z auf 0.`,
      },
      refuse: ({ angle }) =>
        `Das ist ein gestrecktes Bein, ${angle}° vom Mittel. Beim Gehen ist das Knie meistens gebeugt, also ist es auch im Mittel gebeugt.`,
      no: ({ angle }) => `|w| ist ${angle}°.`,
      hints: [
        "Der farbige Fächer schließt sich, wenn das Bein sein Mittel erreicht.",
        "Zieh den Ring am linken Knöchel, oder bring jede Komponente von w auf 0.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitt 4: Gelenkwinkel als Exponentialabbildungen, die Wurzel ohne Position und Richtung.",
    "Die Zahlen sind die aus `rust/strut-core/src/pose_vector.rs`, mit dem Logarithmus aus `rust/strut-core/src/math/exp_map.rs`. Die Mittel sind die der neutralen Aufnahmen der Datenbank.",
  ],
};
