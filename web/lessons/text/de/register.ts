import type { LessonText } from "../text";

export const register: LessonText = {
  idea: [
    "Zwei Menschen machen denselben Schritt, der eine in 1,1 s, der andere in 1,5 s. Um sie zu vergleichen, musst du wissen, welche Augenblicke einander entsprechen.",
    "Eine solche Entsprechung ist ein Pfad: Jedem Augenblick des einen Schritts nennt er einen des anderen. Wo er steil ist, ist der andere langsam.",
    "Üblich ist, ähnliche Bilder zu paaren, insgesamt so billig wie möglich. Das heißt Dynamic Time Warping, DTW.",
  ],
  bet: {
    question:
      "Je grauer eine Stelle, desto weniger gleichen sich die beiden Posen. Ein Pfad läuft mit den kleinsten Kosten durch die Täler, DTW; einer ist gerade. Welcher ist näher an der Wahrheit?",
    options: { true: "Der billigste Pfad", straight: "Die Gerade" },
    reveal: ({ dtw, linear }) =>
      `Der billigste Pfad liegt im Mittel um ${dtw} ms daneben, die Gerade um ${linear} ms. Die Pose eines alten Menschen mitten im Stand gleicht einer neutralen zu einer anderen Zeit, und DTW paart, was sich gleicht. Die Wahrheit ist hier bekannt, denn diese Schritte sind nach Plan aufgeführt.`,
  },
  look: [
    "Nach rechts läuft der neutrale Schritt, nach oben der alte. Das Grau sind [c: die Kosten c], zwei Bilder zu paaren, und [tau: der Punkt] ist das Paar am Zeiger, dessen Gehende unten stehen.",
    "Ein Pfad darf höchstens dreimal so schnell sein wie der andere Schritt, und nicht langsamer als ein Drittel: [s: die beiden Linien durch den Punkt]. Die Balken außen sind Füße, die stehen.",
    "IMW lässt Posen sich um einen [alpha: Faktor α] und einen [beta: Versatz β] unterscheiden, die sich langsam ändern. Was Stil ist, muss dann nicht mit verzogener Zeit bezahlt werden.",
  ],
  symbols: {
    c: { symbol: "c", name: "Kosten des Paars am Zeiger" },
    s: { symbol: "s", name: "Tempo des Pfads dort" },
    tau: { symbol: "τ", name: "Zeit im Schritt mit Stil" },
    alpha: { symbol: "α", name: "Faktor des stärksten Merkmals" },
    beta: { symbol: "β", name: "sein Versatz" },
  },
  why: "Ein Stil ändert, wann und wie sich jemand bewegt. Warum können Kosten der Ähnlichkeit allein die beiden nicht trennen, und was könntest du noch messen?",
  exercises: {
    A: {
      task: "Bieg deinen eigenen Pfad an seinen drei Punkten, bis er höchstens das 1,2-Fache von DTW kostet.",
      pass: ({ cost, off }) =>
        `Ja: das ${cost}-Fache der Kosten, und ${off} ms von der Wahrheit. Billig ist nicht wahr.`,
      near: {
        other: () => "Nimm den alten Schritt.",
        up: ({ cost, dearFrom, dearTo }) =>
          `Knapp: das ${cost}-Fache. Bieg ihn von ${dearFrom} bis ${dearTo} ms nach oben.`,
        down: ({ cost, dearFrom, dearTo }) =>
          `Knapp: das ${cost}-Fache. Bieg ihn von ${dearFrom} bis ${dearTo} ms nach unten.`,
      },
      refuse: ({ cost, off }) =>
        `Du folgst der Wahrheit, ${off} ms von ihr entfernt, zum ${cost}-Fachen der Kosten. Hier geht es nur um Kosten.`,
      no: ({ cost, dearFrom, dearTo }) =>
        `Das ${cost}-Fache der Kosten. Am teuersten: von ${dearFrom} bis ${dearTo} ms.`,
      hints: [
        "Folg dem klaren Tal: Bieg den Pfad, wo ein Fuß aufsetzt, an den Enden der Balken.",
        "Sieh auf den Pfad von DTW: Bring deine Punkte auf ihn, dann verschieb einen nach dem anderen mit den Pfeiltasten.",
      ],
    },
    B: {
      task: "Stell den Zeiger auf einen Augenblick, in dem bei gleichmäßig verteilter Zeit verschiedene Füße stehen, unter DTW aber dieselben.",
      pass: ({ time, tau }) => `Ja: Bei ${time} ms sagt DTW ${tau} ms, und dieselben Füße stehen.`,
      near: {
        other: () => "Nimm den alten Schritt.",
        later: () => "Knapp: etwas später.",
        earlier: () => "Knapp: etwas früher.",
      },
      refuse: ({ time }) =>
        `Bei ${time} ms stehen auch unter DTW verschiedene Füße: Es paart, was sich gleicht, nicht was den Boden berührt.`,
      no: ({ time }) => `Bei ${time} ms stehen schon in linearer Zeit dieselben Füße, oder in keiner von beiden.`,
      hints: [
        "Die Balken außen sind Füße, die stehen. Sieh nach, wo einer endet.",
        "Lies die Zeile unter den Gehenden mit dem Pfad linear, dann mit DTW, an jedem Ende eines Balkens.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitt 4: Registrierung; Hsu, Pulli und Popović, Style translation for human motion, SIGGRAPH 2005: Iterative Motion Warping.",
    "Die Pfade sind die aus `rust/strut-core/src/registration/dtw.rs` und `rust/strut-core/src/registration/imw.rs`. DTW paart ganze Bilder; ein Pfad zwischen den Bildern kann etwas weniger kosten als sein 1 ×.",
  ],
};
