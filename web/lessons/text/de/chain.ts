import type { LessonText } from "../text";

export const chain: LessonText = {
  idea: [
    "Diese Figur hat keine Eingabe. Ein Schritt ist eine Kette aus fünf Zuständen. Jeder Zustand hat Mittel und Varianz jedes Winkels, seiner Geschwindigkeit (der Änderung von Bild zu Bild), seiner Beschleunigung (der Änderung dieser Änderung) und der Dauer des Zustands.",
    "Ein Mittel mit seiner Varianz ist wie eine Zusage: Mit kleiner Varianz ist sie fest, mit großer locker. Das Modell wählt dann die Bewegung, die alle diese Zusagen am besten hält. Es heißt Hidden-Semi-Markov-Modell („semi“, weil es auch Dauern modelliert). Von den Aufnahmen bleiben nur seine Mittel und Varianzen.",
    "Mische die Mittel zweier Modelle, und du hast einen gemischten Gang. Mit k über 1 ist der Stil übertrieben, unter 0 in sein Gegenteil umgekehrt.",
  ],
  bet: {
    question:
      "Die Kurve muss drei Zusagen halten: über den Winkel, seine Geschwindigkeit und seine Beschleunigung. Mach σ″, die Standardabweichung der letzten, kleiner. Wie ändert sich die Kurve?",
    options: { smoother: "Sie wird glatter", same: "Sie bleibt, wie sie ist", rougher: "Sie wird rauer" },
    reveal: ({ leg, toes }) =>
      `Mit einem Zehntel von σ″² ist der Ruck (wie schnell sich die Beschleunigung ändert) am Oberschenkel das ${leg}-Fache von vorher, an den Zehen das ${toes}-Fache. Eine kleine Varianz ist eine feste Zusage: Die Beschleunigung muss nah an ihrem Mittel bleiben, und das schwankt kaum.`,
  },
  look: [
    "Die Treppe ist das [mu: Mittel μ] jedes Zustands, die Bänder sind seine [sigma: Standardabweichung σ]. Die [c: Kurve c] ist die wahrscheinlichste; gestrichelt ist die des trainierten Modells.",
    "Die kurzen Striche sind die [delta: Geschwindigkeiten Δc], die halbe Differenz von nächstem und vorigem Bild; Δ²c ist die Beschleunigung. μ′, σ′ und μ″, σ″ sind ihre Mittel und Standardabweichungen. Die Regler multiplizieren die drei Varianzen, mit einem Tausendstel bis zum Tausendfachen.",
    "Die Blöcke sind die Zustände; ihre Breite ist die [d: Dauer d]. Das d mit Strich ist die mittlere Dauer eines Zustands, ν ihre Varianz. Zieh das Ende eines Schritts: [rho: ρ] verlängert jeden Zustand um das ρ-Fache seines ν, sodass sich die am stärksten schwankenden am meisten ändern.",
    "m₁ ist das Modell des neutralen Gangs, m₂ das des Stils: Mit [k: k] mischst du sie.",
  ],
  symbols: {
    c: { symbol: "c", name: "Kurve; hier ihr Ruck, × der des Modells" },
    mu: { symbol: "μ", name: "Mittel; hier der größte Abstand von c" },
    sigma: { symbol: "σ²", name: "Varianz der Posen; hier ihr Faktor" },
    delta: { symbol: "Δc", name: "Geschwindigkeit; hier Faktoren von σ′², σ″²" },
    d: { symbol: "d", name: "Dauern des linken und rechten Schritts" },
    rho: { symbol: "ρ", name: "Verlängerung der linken und rechten Schritte" },
    k: { symbol: "k", name: "Anteil des Stils" },
  },
  why: "Warum läuft die Kurve nicht durch die Mittel, obwohl nur sie ein Ziel für den Winkel selbst sind? Wie sähe der Gang aus, wenn sie es täte?",
  exercises: {
    A: {
      task: "Bring die Kurve des linken Oberschenkels in jedem Bild auf 2° an die Mittel heran.",
      pass: ({ farthest }) =>
        `Ja: höchstens ${farthest}°. Die Kurve folgt der Treppe: Sie springt von Zustand zu Zustand.`,
      near: {
        other: () => "Sieh auf den linken Oberschenkel des neutralen Gangs: k 0.",
        further: ({ farthest }) => `Knapp: ${farthest}°. Weiter in dieser Richtung.`,
      },
      refuse: ({ farthest }) =>
        `Die Zusage über den Winkel ist jetzt die schwächere: Die Kurve ist ${farthest}° von einem Mittel entfernt. Eine kleine Varianz ist eine feste Zusage.`,
      no: ({ farthest }) => `Die Kurve ist ${farthest}° von einem Mittel entfernt.`,
      hints: [
        "Eine kleine Varianz ist eine feste Zusage. Welche der drei handelt vom Winkel selbst?",
        "Mach σ² so klein, wie es geht, oder σ′² und σ″² so groß.",
      ],
    },
    B: {
      task: "Der Ruck der Zehen ist groß. Bring ihn auf höchstens das 0,5-Fache, wobei die Kurve höchstens 2,2 σ von den Mitteln entfernt bleibt (mit dem σ des Modells).",
      pass: ({ jerkShare, deviations }) => `Ja: das ${jerkShare}-Fache des Rucks, bei ${deviations} σ.`,
      near: {
        other: () => "Sieh auf die linken Zehen des neutralen Gangs: k 0.",
        far: ({ jerkShare, deviations }) =>
          `Knapp: glatt, das ${jerkShare}-Fache, aber ${deviations} σ von einem Mittel. Etwas weniger fest.`,
        rough: ({ jerkShare, deviations }) => `Knapp: das ${jerkShare}-Fache, bei ${deviations} σ. Etwas fester.`,
      },
      refuse: ({ jerkShare, deviations }) =>
        `Das ${jerkShare}-Fache des Rucks, aber ${deviations} σ von einem Mittel: Eine zu feste Zusage bricht die anderen.`,
      no: ({ jerkShare }) => `Der Ruck ist das ${jerkShare}-Fache der Kurve des Modells.`,
      hints: [
        "Ruck ist, wie schnell sich die Beschleunigung ändert. Mach die Zusage über die Beschleunigung fester.",
        "Dreh σ″² herunter, auf etwas zwischen einem Zehntel und einem Dreißigstel.",
      ],
    },
    C: {
      task: "Verlangsame den neutralen Gang mit ρ auf 100 Schritte in der Minute, auf 1 genau.",
      pass: ({ cadence, left, right }) => `Ja: ${cadence} Schritte in der Minute mit ρ ${left} und ${right}.`,
      near: {
        other: () => "Nimm den neutralen Gang: k 0.",
        longer: ({ cadence }) => `Knapp: ${cadence}. Mach die Schritte etwas länger.`,
        shorter: ({ cadence }) => `Knapp: ${cadence}. Mach die Schritte etwas kürzer.`,
      },
      refuse: ({ cadence }) =>
        `Ein negatives ρ verkürzt die Zustände: ${cadence} Schritte in der Minute. Langsamere Schritte dauern länger.`,
      no: ({ cadence }) => `${cadence} Schritte in der Minute.`,
      hints: [
        "Je länger jeder Schritt dauert, desto weniger sind es in der Minute.",
        "Linke und rechte Schritte zählen. Versuch ρ nahe 1 für beide.",
      ],
    },
  },
  sources: [
    "Tilmanne und Dutoit, Continuous control of style and style transitions through linear interpolation in hidden Markov model based walk synthesis, 2012, Abschnitte 4 bis 6: Modelle von Schritten, Bewegungen nach größter Wahrscheinlichkeit, Dauern, Steuerung des Stils.",
    "Bewegungen berechnet `rust/strut-core/src/hsmm/mlpg.rs`; Dauern, und was sie begrenzt, sind die aus `rust/strut-core/src/hsmm/walker/durations.rs`.",
  ],
};
