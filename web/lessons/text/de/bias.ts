import type { LessonText } from "../text";

export const bias: LessonText = {
  idea: [
    "Die Eingabe geht mit gehobenen Armen. Kein Gang der Datenbank ist so, also lassen die nächsten Beispiele die Arme hängen.",
    "Eine Gerade, die an solche Beispiele angepasst ist, weiß nichts von gehobenen Armen. Weit außerhalb ihrer Punkte wäre ihre Antwort Unsinn.",
    "Darum legt die Engine den Teil der Pose beiseite, den kein Beispiel abdeckt, stilisiert den Rest und addiert einen Anteil dieses Teils wieder. Wie groß soll der Anteil sein?",
  ],
  bet: {
    question: "Setze den Anteil auf 0: Nichts wird wieder addiert. Wie viel vom Heben bleibt?",
    options: { little: "So gut wie nichts", half: "Etwa die Hälfte", all: "Fast alles" },
    reveal: ({ share, usual, keep }) =>
      `${share} davon. Nur die Beispiele entscheiden, und ihre Arme hängen. Mit der Einstellung der Engine, ρ = ${keep}, bleibt vom Heben ${usual}.`,
  },
  look: [
    "Die Punkte sind die Winkel der Nachbarn. Das Band um ihr [mu: Mittel μ] reicht nach beiden Seiten [kappa: κ] mal so weit wie ihre [sigma: Standardabweichung σ].",
    "Liegt die [x: Eingabe x] außerhalb des Bandes, schiebt clamp sie an sein nächstes Ende. Der abgeschnittene Teil ist der [dx: Bias Δx].",
    "Die Gerade β aus Lektion 5 ist an Beispiele ohne gehobene Arme angepasst, also muss die Eingabe erst in ihren Bereich zurück: ũ ist die Eingabe jetzt und ein Bild vorher minus Δx, und die letzte Ausgabe minus ρΔx. Die Antwort der Geraden ist [beta: der Ring].",
    "Dann wird der [rho: Anteil ρ] des Bias wieder addiert, und die Ausgabe ist [y: y]. Zieh die Eingabe die Achse entlang, und dreh ρ zwischen 0 und 1.",
  ],
  symbols: {
    x: { symbol: "xₜ", name: "Winkel des Arms der Eingabe" },
    mu: { symbol: "μ", name: "Mittel der Nachbarn" },
    sigma: { symbol: "σ", name: "ihre Standardabweichung" },
    kappa: { symbol: "κ", name: "halbe Breite des Bandes, in σ" },
    dx: { symbol: "Δx", name: "Bias: der Teil außerhalb des Bandes" },
    beta: { symbol: "ũᵀβ", name: "Antwort der Geraden" },
    rho: { symbol: "ρ", name: "Anteil, der wieder addiert wird" },
    y: { symbol: "yₜ", name: "Winkel der Ausgabe" },
  },
  why: "Wann würdest du ρ = 1 wählen, wann ρ = 0? Denk an eine Person, die ein Tablett trägt, und an einen schlecht aufgenommenen Arm.",
  exercises: {
    A: {
      task: "Die Arme sind um 60° gehoben. Finde das ρ, bei dem über den ganzen Gang die Hälfte des Hebens bleibt, auf 0,02 genau.",
      pass: ({ keep, share }) => `Ja: Mit ρ ${keep} bleibt vom Heben ${share}.`,
      near: {
        other: () => "Lass das Heben bei 60°, κ und den Stil, wie sie waren: Nur ρ soll sich ändern.",
        more: ({ share }) => `Knapp: Es bleibt ${share}. Etwas mehr ρ.`,
        less: ({ share }) => `Knapp: Es bleibt ${share}. Etwas weniger ρ.`,
      },
      refuse: ({ keep, share }) =>
        `ρ ist ein Anteil des Bias an einem Gelenk, nicht des Hebens: Mit ρ ${keep} bleibt ${share}.`,
      no: ({ keep, share }) => `Mit ρ ${keep} bleibt vom Heben ${share}.`,
      hints: [
        "Je mehr vom Bias wieder addiert wird, desto mehr bleibt vom Heben. Aber der Arm im Stil hängt anders als der neutrale, darum sind die Anteile nicht gleich.",
        "Hebe ρ hervor: Sein Pfeil zeigt den Teil, der wieder addiert wird, hier und genauso an jedem Gelenk. Fang bei ρ = 1 an und geh herunter.",
      ],
    },
    B: {
      task: "Jetzt sind die Arme nur um 10° gehoben. Welches ist in diesem Augenblick das kleinste κ, bei dem die Eingabe im Band liegt? Bis zu 0,3 mehr zählt noch.",
      pass: ({ reach }) => `Ja: Mit κ ${reach} reicht das Band gerade bis zur Eingabe.`,
      near: {
        other: () => "Lass das Heben bei 10°, den Augenblick und den Stil, wie sie waren.",
        more: ({ bias }) => `Knapp: ${bias}° liegen noch außerhalb. Etwas mehr κ.`,
        less: ({ reach }) => `Knapp: Mit κ ${reach} liegt die Eingabe im Band, aber etwas weniger κ genügt.`,
      },
      refuse: ({ reach }) =>
        `Die Eingabe liegt im Band, aber κ ${reach} ist größer als nötig: Die Gerade wird weit von ihren Punkten benutzt.`,
      no: ({ bias, reach }) => `Mit κ ${reach} liegen ${bias}° außerhalb des Bandes.`,
      hints: [
        "Das Band endet, wo |x − μ| = κσ ist.",
        "Hebe x, μ und σ hervor: Ihre Werte stehen unter der Gleichung. Teile.",
      ],
    },
    C: {
      task: "Die Arme sind wieder um 60° gehoben. Wie viel Grad werden an diesem Gelenk wieder addiert? Berechne ρΔx und trage es ein.",
      pass: ({ returned }) => `Ja: ${returned}° werden wieder addiert.`,
      near: {
        other: () => "Lass Heben, κ, ρ, Augenblick und Stil, wie sie waren. „Anfangen“ bringt sie zurück.",
        more: ({ guess }) => `Knapp: etwas mehr als ${guess}°.`,
        less: ({ guess }) => `Knapp: etwas weniger als ${guess}°.`,
        none: () => "Trage unter der Abbildung eine Zahl in Grad ein.",
        edge: ({ guess }) =>
          `Knapp: ${guess}°. Achte auf den Rand des Bandes: Der Bias beginnt bei μ ± κσ, nicht bei μ.`,
      },
      refuse: ({ guess }) => `Du hast das ganze x genommen: ${guess}°. Nur der Teil außerhalb des Bandes ist der Bias.`,
      no: ({ guess }) => `${guess}° ist nicht der Teil, der wieder addiert wird.`,
      hints: [
        "Nur der Teil außerhalb des Bandes zählt.",
        "Δx = x − (μ + κσ), denn die Eingabe liegt über dem Band. Dann nimm davon den Anteil ρ.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai und Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Gl. 6 und 7. Der Artikel druckt yₜ = ũᵀβ − ρΔx; die Engine addiert ρΔx, denn mit dem Minus schöbe ein größeres ρ die Ausgabe von der Eingabe weg.",
    "Der Bias wird in `rust/strut-core/src/transfer/bias.rs` entfernt und wieder addiert. Für Nachbarn, die sich einig sind, hat σ einen Mindestwert, damit Rauschen nicht als Inhalt zählt.",
  ],
};
