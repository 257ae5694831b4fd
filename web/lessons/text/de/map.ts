import type { LessonText } from "../text";

export const map: LessonText = {
  idea: [
    "Zwei Zahlen, die Stilvariablen, ergeben eine ganze Pose: Sie legen fest, wie weit die Füße in Gehrichtung und in der Höhe auseinander sind. Zieh den Punkt, und der Körper folgt.",
    "Mehrere lineare Abbildungen machen aus den beiden Zahlen die Pose. Jede deckt ein Gebiet der Ebene ab, und wo Gebiete sich treffen, teilen sich die Abbildungen die Antwort.",
    "Sie organisieren sich selbst: Jedes aufgenommene Bild zieht an den Abbildungen, die ihm nah sind, erst an vielen zugleich, dann an immer weniger. Ein solcher Zug ist ein Lernschritt.",
  ],
  bet: {
    question:
      "Ein Lernschritt bewegt eine Abbildung auf die Stichprobe zu, ein aufgenommenes Bild. Der Artikel druckt die Formel mit einem Minus, das sie davon wegbewegt. Was geschieht, wenn du die gedruckte Formel benutzt?",
    options: {
      same: "Es lernt genauso gut",
      slower: "Es lernt langsamer",
      diverges: "Der Fehler wächst ohne Ende",
    },
    reveal: ({ updates, right, printed }) =>
      `Nach ${updates} Schritten ist der Fehler ${right}° mit dem richtigen Vorzeichen und ${printed}° wie gedruckt. Jeder Schritt bewegt die Abbildung von der Stichprobe weg, und je größer der Abstand, desto länger der nächste Schritt.`,
  },
  look: [
    "Die Punkte sind aufgenommene Bilder, angeordnet nach ihren Stilvariablen. Jede Ellipse ist das Gebiet einer Komponente, einer Abbildung Zᵢ: mᵢ ist ihre Mitte, Sᵢ ihre Streuung. Je dunkler sie ist, desto größer ihr [a: Anteil a] an allen Stichproben. Mach einen Lernschritt: Der Ring ist [x: die Stichprobe x], und die Balken zeigen [r: den Teil r], den jede Komponente davon nimmt.",
    "Die Abbildung Zᵢ macht aus v (den beiden Variablen und einer 1) eine Pose. Die undurchsichtige Figur ist die Pose der Stichprobe, die durchscheinende [Z: die Vorhersage Zv]. Ein Lernschritt bewegt Zv um den Anteil δ r auf x zu; δ ist die [delta: Lernrate]. Die Striche zeigen, wie weit er die Mitten bewegt hat.",
    "Der gestrichelte Ring zeigt die [sigma: Breite σ] der Nachbarschaft: Eine Komponente, deren Vorhersage weiter als σ von der Stichprobe ist, nimmt wenig von ihr. Von Durchgang zu Durchgang werden σ und δ kleiner, sodass am Ende nur noch die nächste Komponente lernt. Die Kurve ist der [E: Fehler] des Modells nach jedem Durchgang. Drück auf Abspielen, und versuch auch das Vorzeichen wie gedruckt.",
    "Zuletzt forderst du eine Pose an: [u: Zieh u]. Alle Abbildungen antworten; das [w: Gewicht w] jeder hängt davon ab, wie gut u zu ihrem mᵢ und Sᵢ passt. Je höher die Temperatur [T: T], desto gleicher die Gewichte.",
  ],
  symbols: {
    u: { symbol: "u", name: "angeforderte Stilvariablen" },
    x: { symbol: "x", name: "die Stichprobe, durch ihre Variablen" },
    r: { symbol: "rᵢ", name: "der größte Teil der Stichprobe" },
    a: { symbol: "aᵢ", name: "der größte Anteil" },
    Z: { symbol: "Zᵢv", name: "Abstand der Vorhersage von x" },
    delta: { symbol: "δ", name: "Lernrate" },
    sigma: { symbol: "σ", name: "Breite der Nachbarschaft" },
    w: { symbol: "w", name: "größtes Gewicht in der Pose" },
    T: { symbol: "T", name: "Temperatur des Teilens" },
    E: { symbol: "E", name: "Fehler nach dem letzten Durchgang" },
  },
  why: "Warum beginnt die Nachbarschaft breit? Denk an eine Abbildung, die nie eine Stichprobe bekommt, und an Nachbarn, die Verschiedenes lernen.",
  exercises: {
    A: {
      task: "Wann hat das Modell gelernt? Finde den ersten Durchgang (durch alle Bilder), nach dem der Fehler höchstens das 1,05-Fache dessen nach dem letzten ist.",
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
      task: "Das Ziehen soll glatt sein: Stell T so ein, dass sich auf zehn festen Wegen kein Gelenk um mehr als 6° je Bild dreht und der Fehler bei aufgenommenen Posen höchstens 2° ist.",
      pass: ({ temperature, change, shared }) =>
        `Ja: mit T ${temperature} ${change}° je Bild bei einem Fehler von ${shared}°.`,
      near: {
        softer: ({ change }) => `Knapp: ${change}° je Bild. Etwas mehr T.`,
        harder: ({ shared }) => `Knapp: Der Fehler ist ${shared}°. Etwas weniger T.`,
      },
      refuse: ({ change }) =>
        `Gewichte, die schlagartig wechseln, lassen den Körper springen: ${change}° je Bild. Mit höherem T teilen sich die Abbildungen die Pose.`,
      no: ({ change, shared }) => `${change}° je Bild, bei einem Fehler von ${shared}°.`,
      hints: [
        "Je höher T, desto weicher der Wechsel von Abbildung zu Abbildung, und desto weniger gilt jede einzelne.",
        "Beide Zahlen stehen unter der Ebene. Dreh T langsam hinauf.",
      ],
    },
    C: {
      task: "Ein Schlüsselbild legt die zwei Zahlen in einem Augenblick fest, eine glatte Kurve verbindet sie. Mach den Zyklus aus höchstens 3 Schlüsselbildern, mit einem mittleren Fehler von höchstens 2°.",
      pass: ({ count, keyed }) =>
        `Ja: ${count} Schlüsselbilder mit je zwei Zahlen, und ${keyed}° Fehler für einen ganzen Zyklus.`,
      near: {
        fewer: ({ count, keyed }) => `${keyed}° ist gut, aber ${count} Schlüsselbilder sind zu viele.`,
        turns: ({ keyed, from, to, worst }) =>
          `Knapp: ${keyed}°. Vom Schlüsselbild bei ${from} ms bis ${to} ms liegt er um bis zu ${worst}° daneben.`,
      },
      refuse: ({ count, from, to, worst }) =>
        `${count} Schlüsselbilder sind zu wenige: Vom Schlüsselbild bei ${from} ms bis ${to} ms liegt er um bis zu ${worst}° daneben.`,
      no: ({ keyed, from, to, worst }) =>
        `${keyed}°. Vom Schlüsselbild bei ${from} ms bis ${to} ms liegt er um bis zu ${worst}° daneben.`,
      hints: [
        "Die Kurve durch die Schlüsselbilder soll dort wenden, wo die aufgenommene wendet. Setz sie dorthin, wo sich die Richtung ändert.",
        "Nimm drei Schlüsselbilder, etwa ein Drittel des Zyklus auseinander, und verschieb sie gemeinsam.",
      ],
    },
  },
  sources: [
    "Wang, Liu und Zhou, Key-styling: learning motion style for real-time synthesis of 3D animation, 2006. Gl. 7 und 8 drucken das umgekehrte Vorzeichen, und Gewichte nach Gebieten von Stilen (mᵢ, Sᵢ) gibt es dort nicht; `docs/methods/somn.md` sagt, warum beides geändert ist.",
    "Lernschritte macht `rust/strut-core/src/somn/learning.rs`, Posen `rust/strut-core/src/somn/synthesis.rs`, und Zyklen aus Schlüsselbildern `rust/strut-core/src/somn/key_styling.rs`.",
  ],
};
