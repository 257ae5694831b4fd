import type { LessonText } from "../text";

export const map: LessonText = {
  idea: [
    "Zwei Zahlen, eine ganze Pose: wie weit die Füße längs des Wegs auseinander sind, und in der Höhe. Zieh den Punkt, und der Körper folgt.",
    "Dahinter sind etwa ein Dutzend lineare Abbildungen von den beiden Zahlen auf die Pose. Jede kennt ein Gebiet von Stilen, und wo Gebiete sich treffen, teilen sie sich die Antwort.",
    "Sie organisieren sich selbst: Jedes aufgenommene Bild zieht an den Abbildungen, die ihm nah sind, erst an vielen zugleich, dann an immer weniger. Ein solcher Zug ist ein Lernschritt.",
  ],
  bet: {
    question:
      "Ein Lernschritt bewegt eine Abbildung auf die Probe zu. Der Artikel druckt die Formel mit einem Minus, also bewegt sie sich von ihr weg. Was geschieht, wenn du dem Druck folgst?",
    options: {
      same: "Es lernt genauso gut",
      slower: "Es lernt langsamer",
      diverges: "Der Fehler wächst ohne Ende",
    },
    reveal: ({ updates, right, printed }) =>
      `Nach ${updates} Schritten ist der Fehler ${right} rad mit dem richtigen Vorzeichen, und ${printed} rad wie gedruckt. Jeder Schritt vergrößert den Abstand, und der nächste ist um so viel länger.`,
  },
  look: [
    "Die Punkte sind aufgenommene Bilder, und jede Ellipse ist, was eine Komponente kennt: dunkler, wo ihr [a: Anteil a] größer ist. Mach einen Schritt: Der Ring ist [x: die Probe], und die Balken sind, [r: wie viel davon] jede Komponente nimmt.",
    "Der gestrichelte Ring ist die [sigma: Breite σ] der Nachbarschaft. Sie wird von Durchgang zu Durchgang enger, wie auch die [delta: Rate δ], sodass am Ende nur noch die Siegerin lernt.",
    "Die Kurve hat den [E: Fehler] des Modells nach jedem Durchgang, den du gemacht hast. Versuch auch das Vorzeichen wie gedruckt.",
  ],
  symbols: {
    u: { symbol: "u", name: "Stilvariablen; Zahl der Schlüssel" },
    x: { symbol: "x", name: "die Probe, durch ihre Variablen" },
    r: { symbol: "rᵢ", name: "der größte Teil der Probe" },
    a: { symbol: "aᵢ", name: "der größte Anteil" },
    delta: { symbol: "δ", name: "Lernrate" },
    sigma: { symbol: "σ", name: "Breite der Nachbarschaft" },
    w: { symbol: "w", name: "größtes Gewicht in der Pose" },
    T: { symbol: "T", name: "Temperatur des Teilens" },
    E: { symbol: "E", name: "Fehler des Modells oder des Zyklus" },
  },
  why: "Warum beginnt die Nachbarschaft breit? Überleg, was eine Abbildung lernte, die nie eine Probe bekam, und was bei Nachbarn geschähe, die Verschiedenes lernten.",
  exercises: {
    A: {
      task: "Wann hat es gelernt? Finde den ersten Durchgang, nach dem der Fehler höchstens das 1,05-Fache dessen nach dem letzten ist.",
      pass: ({ pass, learned, last }) =>
        `Ja: Durchgang ${pass}, ${learned}°, und ${last}° am Ende. Der Rest ist Feinschliff.`,
      near: {
        later: ({ pass, learned }) => `Knapp: ${learned}° nach Durchgang ${pass}. Etwas später.`,
        earlier: ({ pass, learned }) =>
          `${learned}° nach Durchgang ${pass} reicht, aber ein früherer Durchgang reichte auch.`,
      },
      refuse: ({ passes, last }) =>
        `Nach ${passes} Durchgängen sind es ${last}°. Das ist das Ende; das Lernen war lange vorher fast vorbei.`,
      no: ({ pass, learned }) => `Nach Durchgang ${pass} ist der Fehler ${learned}°.`,
      hints: [
        "Zieh die Fahne zuerst ans Ende, und lies den letzten Fehler ab. Nimm ihn mal 1,05.",
        "Dann geh mit den Pfeiltasten zurück, bis der Fehler knapp darunter liegt.",
      ],
    },
    B: {
      task: "Ziehen darf nicht rucken: Stell T so ein, dass sich auf zehn festen Wegen kein Gelenk um mehr als 6° je Bild dreht, aufgenommene Posen aber noch auf 2° stimmen.",
      pass: ({ temperature, change, shared }) =>
        `Ja: mit T ${temperature} ${change}° je Bild bei einem Fehler von ${shared}°.`,
      near: {
        softer: ({ change }) => `Knapp: ${change}° je Bild. Etwas weicher.`,
        harder: ({ shared }) => `Knapp: Der Fehler ist ${shared}°. Etwas härter.`,
      },
      refuse: ({ change }) =>
        `Anteile, die auf einmal wechseln, lassen den Körper springen: ${change}° je Bild. Ein höheres T lässt Nachbarn teilen.`,
      no: ({ change, shared }) => `${change}° je Bild, bei einem Fehler von ${shared}°.`,
      hints: [
        "Je höher T, desto weicher der Wechsel von Abbildung zu Abbildung, und desto weniger gilt jede einzelne.",
        "Beide Zahlen stehen unter der Ebene. Fang bei T 3 an, und geh hinauf.",
      ],
    },
    C: {
      task: "Mach den Zyklus aus höchstens 3 Schlüsseln, mit einem mittleren Fehler von höchstens 2°.",
      pass: ({ count, keyed }) =>
        `Ja: ${count} Schlüssel mit je zwei Zahlen, und ${keyed}° Fehler für einen ganzen Zyklus.`,
      near: {
        fewer: ({ count, keyed }) => `${keyed}° ist gut, aber ${count} Schlüssel sind zu viele.`,
        turns: ({ keyed, from, to, worst }) =>
          `Knapp: ${keyed}°. Vom Schlüssel bei ${from} ms bis ${to} ms liegt er um bis zu ${worst}° daneben.`,
      },
      refuse: ({ count, from, to, worst }) =>
        `${count} Schlüssel sind zu wenige: Vom Schlüssel bei ${from} ms bis ${to} ms liegt er um bis zu ${worst}° daneben.`,
      no: ({ keyed, from, to, worst }) =>
        `${keyed}°. Vom Schlüssel bei ${from} ms bis ${to} ms liegt er um bis zu ${worst}° daneben.`,
      hints: [
        "Eine Kurve durch wenige Schlüssel stimmt, wenn sie wendet, wo die aufgenommene wendet: Schlüssel, wo die Richtung wechselt.",
        "Nimm drei Schlüssel, etwa ein Drittel des Zyklus auseinander, und verschieb sie gemeinsam.",
      ],
    },
  },
  sources: [
    "Wang, Liu und Zhou, Key-styling: learning motion style for real-time synthesis of 3D animation, 2006. Gl. 7 und 8 drucken das umgekehrte Vorzeichen, und ein Gate für Gebiete von Stilen gibt es nicht; `docs/methods/somn.md` sagt, warum beides geändert ist.",
    "Lernschritte macht `rust/strut-core/src/somn/learning.rs`, Posen `rust/strut-core/src/somn/synthesis.rs`, und Zyklen aus Schlüsseln `rust/strut-core/src/somn/key_styling.rs`.",
  ],
};
