import type { LessonText } from "../text";

export const register: LessonText = {
  idea: [
    "Zwei Menschen machen denselben Schritt (hier: links und rechts, bis die linke Ferse wieder aufsetzt), der eine in 1,1 s, der andere in 1,5 s. Um sie zu vergleichen, musst du wissen, welche Augenblicke einander entsprechen.",
    "Eine solche Entsprechung ist ein Pfad: Zu jedem Augenblick des einen Schritts nennt er einen des anderen. Wo der Pfad steil ist, braucht der andere für denselben Teil des Schritts länger.",
    "Die übliche Methode gibt jedem Paar von Bildern Kosten, kleine, wenn sie sich gleichen, und wählt den Pfad mit den kleinsten Gesamtkosten. Sie heißt Dynamic Time Warping, DTW.",
  ],
  bet: {
    question:
      "Je dunkler eine Stelle im Bild, desto weniger gleichen sich die beiden Posen. Ein Pfad, DTW, folgt mit den kleinsten Kosten den hellen Tälern; der andere ist gerade. Welcher ist näher an der Wahrheit?",
    options: { true: "Der billigste Pfad", straight: "Die Gerade" },
    reveal: ({ dtw, linear }) =>
      `Der billigste Pfad liegt im Mittel um ${dtw} ms daneben, die Gerade um ${linear} ms. Eine alte Figur kann mitten im Schritt aussehen wie eine neutrale zu einer anderen Zeit, und DTW paart ähnliche Posen. Die Wahrheit ist hier bekannt, denn ein Programm hat beide Schritte erzeugt.`,
  },
  look: [
    "Nach rechts läuft der neutrale Schritt, nach oben der alte. Die Schattierung sind die [c: Kosten c] eines Paars von Bildern: der quadrierte Abstand ihrer Merkmale (Positionen und Geschwindigkeiten der Gelenke, und die Bodenkontakte). Der [tau: Punkt τ] ist das Paar am Zeiger; seine beiden Figuren stehen darunter.",
    "Cᵢⱼ sind die kleinsten Kosten eines Pfads vom Anfang bis zum Paar i, j. Von einem Paar zum nächsten rückt der Pfad in beiden Schritten um ein Bild vor, oder in einem um [s: s] Bilder und im anderen um eines, mit s höchstens 3. Also ist seine Steigung höchstens drei zu eins: die zwei dünnen Linien durch den Punkt.",
    "Iterative Motion Warping, IMW, erlaubt, dass sich die Merkmale a des neutralen Schritts von den Merkmalen b des anderen um einen [alpha: Faktor α] und einen [beta: Versatz β] unterscheiden. So kann IMW einen Unterschied im Stil als Änderung von Größe oder Lage erklären, statt die Zeit zu verzerren. IMW minimiert E: D ist der Unterschied aufeinanderfolgender Bilder, also lässt der Term mit λ = 225 α und β sich nur langsam ändern, und der mit μ = 0,1 hält sie nahe bei 1 und 0.",
    "Die Balken außerhalb des Diagramms zeigen, wann jeder Fuß steht: oben bei der neutralen Figur, rechts bei der anderen.",
  ],
  symbols: {
    c: { symbol: "c", name: "Kosten des Paars am Zeiger" },
    s: { symbol: "s", name: "Tempo des Pfads am Zeiger" },
    tau: { symbol: "τ", name: "Zeit, mit der es gepaart ist" },
    alpha: { symbol: "α", name: "Faktor des stärksten Merkmals, IMW" },
    beta: { symbol: "β", name: "sein Versatz" },
  },
  why: "Ein Stil ändert das Timing und die Posen. Warum können Kosten, die nur Ähnlichkeit messen, beides nicht trennen, und was könntest du noch messen?",
  exercises: {
    A: {
      task: "Bieg deinen eigenen Pfad an seinen drei Punkten, bis er höchstens das 1,2-Fache von DTW kostet.",
      pass: ({ cost, off }) =>
        `Ja: das ${cost}-Fache der Kosten, und ${off} ms von der Wahrheit. Ein billiger Pfad muss kein wahrer sein.`,
      near: {
        other: () => "Nimm den alten Schritt.",
        up: ({ cost, dearFrom, dearTo }) =>
          `Knapp: das ${cost}-Fache. Bieg ihn von ${dearFrom} bis ${dearTo} ms nach oben.`,
        down: ({ cost, dearFrom, dearTo }) =>
          `Knapp: das ${cost}-Fache. Bieg ihn von ${dearFrom} bis ${dearTo} ms nach unten.`,
      },
      refuse: ({ cost, off }) =>
        `Dein Pfad ist nur ${off} ms von der Wahrheit entfernt, kostet aber das ${cost}-Fache von DTW. Hier geht es nur um Kosten.`,
      no: ({ cost, dearFrom, dearTo }) =>
        `Das ${cost}-Fache der Kosten von DTW. Die meisten Mehrkosten entstehen von ${dearFrom} bis ${dearTo} ms.`,
      hints: [
        "Folge dem hellen Tal. Es knickt, wo ein Fuß aufsetzt oder abhebt, an den Enden der Balken.",
        "Setz deine drei Punkte auf den Pfad von DTW, wo er knickt. Dann verschieb einen nach dem anderen mit den Pfeiltasten.",
      ],
    },
    B: {
      task: "Stell den Zeiger auf einen Augenblick, in dem beim linearen Pfad verschiedene Füße stehen, bei DTW aber dieselben.",
      pass: ({ time, tauDtw, tauLinear }) =>
        `Ja: DTW paart ${time} ms mit ${tauDtw} ms, wo dieselben Füße stehen. Der lineare Pfad paart sie mit ${tauLinear} ms, wo andere stehen.`,
      near: {
        other: () => "Nimm den alten Schritt.",
        later: () => "Knapp: etwas später.",
        earlier: () => "Knapp: etwas früher.",
      },
      refuse: ({ time }) =>
        `Bei ${time} ms stehen auch bei DTW verschiedene Füße: Es paart ähnliche Posen, selbst wenn andere Füße stehen.`,
      no: ({ time }) => `Bei ${time} ms stehen schon beim linearen Pfad dieselben Füße.`,
      hints: [
        "Die Balken außen zeigen, wann jeder Fuß steht. Sieh nach, wo einer endet.",
        "Lies an jedem Ende eines Balkens die Zeile unter den Figuren: einmal mit dem linearen Pfad, einmal mit DTW.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Abschnitt 4: Registrierung; Hsu, Pulli und Popović, Style translation for human motion, SIGGRAPH 2005: Iterative Motion Warping.",
    "Die Pfade sind die aus `rust/strut-core/src/registration/dtw.rs` und `rust/strut-core/src/registration/imw.rs`. DTW paart ganze Bilder, darum kann ein Pfad zwischen den Bildern etwas weniger kosten als 1 ×.",
  ],
};
