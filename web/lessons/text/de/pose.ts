import type { LessonText } from "../text";

export const pose: LessonText = {
  idea: [
    "Um eine Pose vorherzusagen, muss sie aus Zahlen bestehen. Jedes Gelenk ist eine Drehung gegen seinen Vorgänger, und eine Drehung ist eine Achse und ein Winkel.",
    "Multiplizier die Achse mit dem Winkel, und du hast drei Zahlen. Sie zählen von der mittleren Drehung des Gelenks aus, also sind sie klein, solange sich ein Körper bewegt, wie Körper es tun.",
    "Zwanzig Gelenke und die Neigung der Hüfte sind 63 Zahlen. Vier weitere sagen, wie hoch die Hüfte ist und wie schnell der Gehende sich bewegt und dreht.",
  ],
  bet: {
    question: "Dreh den Gehenden um 90°. Wie viele der 67 Zahlen seiner Pose ändern sich?",
    options: { none: "Keine", few: "Ein paar: die der Hüfte", all: "Fast alle" },
    reveal: ({ changed, of, turn }) =>
      `${changed} von ${of}, bei ${turn}°. Ort und Richtung sind abgetrennt: Geschwindigkeiten sind vom Gehenden aus gesehen, und die Neigung der Hüfte ist, was ohne die Richtung bleibt.`,
  },
  look: [
    "Der Pfeil ist [w: w]: die Achse, um die das Gelenk von [mean: seinem Mittel], dem Geist, weggedreht ist. Der gefüllte Fächer ist der Winkel, sein Ende [R: das Gelenk, wie es ist].",
    "Zieh ein Glied an seinem Ring, oder stell die drei Komponenten ein. Nur die Zahlen dieses Gelenks ändern sich; alle anderen bleiben.",
    "Die letzten vier Felder sind die [h: Höhe der Hüfte], ihre [v: Geschwindigkeit] nach links und vorwärts, und [psi: wie schnell sich die Richtung dreht].",
  ],
  symbols: {
    w: { symbol: "wⱼ", name: "Achse mal Winkel, vom Mittel aus; Länge" },
    mean: { symbol: "R̄ⱼ", name: "mittlere Drehung des Gelenks; Winkel" },
    R: { symbol: "Rⱼ", name: "Drehung des Gelenks; Winkel" },
    h: { symbol: "h", name: "Höhe der Hüfte" },
    v: { symbol: "v", name: "Geschwindigkeit, vom Gehenden gesehen" },
    psi: { symbol: "ψ̇", name: "wie schnell er sich dreht" },
  },
  why: "Winkel von 179° und −179° sind fast dieselbe Drehung, aber als Zahlen weit auseinander. Warum ist es schlecht für eine Vorhersage, wenn ein Gelenk dort ist, und wie hilft das Mittel?",
  exercises: {
    A: {
      task: "Wer ein Skelett baut, legt die eigenen Achsen eines Gelenks nach Belieben. Dreh die des linken Oberschenkels um φ, bis log R von einem Bild zum nächsten um mehr als 1,5 rad springt.",
      pass: ({ phi, rawJump, jump }) =>
        `Ja: Bei φ ${phi}° springt log R um ${rawJump} rad, w nie um mehr als ${jump} rad. Das Mittel nimmt die Achsen weg.`,
      near: {
        other: () => "Lies den linken Oberschenkel, ohne gebeugtes Glied, den Gehenden nicht gedreht.",
        further: ({ phi }) => `Knapp: Bei φ ${phi}° sind beide noch glatt. Etwas weiter.`,
      },
      refuse: ({ phi }) => `Beide sind glatt bei φ ${phi}°: Dreh weiter.`,
      no: ({ rawJump }) => `log R springt um ${rawJump} rad.`,
      hints: [
        "Ein Winkel von 180° ist der Rand: Dahinter klappt die Achse um.",
        "Der Oberschenkel schwingt um einige zehn Grad. Gib φ dazu, bis das Schwingen 180° erreicht.",
      ],
    },
    B: {
      task: "Bring das linke Knie in diesem Augenblick in sein Mittel: auf 3° an den Geist heran.",
      pass: ({ angle }) => `Ja: |w| ist ${angle}°. In seinem Mittel sind alle drei Zahlen eines Gelenks fast 0.`,
      near: {
        other: () => "Lies den linken Unterschenkel, im Augenblick des Anfangs.",
        bend: ({ angle }) => `Knapp: ${angle}°. Beug es etwas mehr.`,
        stretch: ({ angle }) => `Knapp: ${angle}°. Streck es etwas.`,
      },
      refuse: ({ angle }) =>
        `Das ist ein gestrecktes Bein, ${angle}° vom Mittel. Niemand geht auf gestreckten Beinen: Das mittlere Knie ist gebeugt.`,
      no: ({ angle }) => `|w| ist ${angle}°.`,
      hints: [
        "Der Fächer schließt sich, wenn Glied und Geist sich treffen.",
        "Zieh den Ring am linken Knöchel, oder bring jede Komponente von w auf 0.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitt 4: Gelenkwinkel als Exponentialkarten, die Wurzel ohne Ort und Richtung.",
    "Die Zahlen sind die aus `rust/strut-core/src/pose_vector.rs`, mit dem Logarithmus aus `rust/strut-core/src/math/exp_map.rs`. Mittel sind über die neutralen Aufnahmen der Datenbank genommen.",
  ],
};
