/** Figures of key-styling in German. */
import type { Words } from "../words";

/** A count with its noun. */
const counted = (count: string, one: string, many: string) => `${count} ${count === "1" ? one : many}`;

export const map: Words["map"] = {
  som: "Komponenten und ihre Gebiete",
  learning: "Fehler nach jedem Durchgang",
  pad: "Zieh die Füße auseinander",
  posed: "Die Pose zu diesen Variablen",
  update: "Die Stichprobe und die Vorhersage der Abbildungen",
  keys: "Ein Zyklus aus Schlüsselbildern",
  temperature: { symbol: "T", name: "Temperatur T", description: "Wie weich Komponenten sich eine Pose teilen." },
  steps: { one: "1 Schritt", ten: "10", pass: "Durchgang", all: "alle", restart: "Von vorn" },
  printed: "Vorzeichen wie gedruckt",
  handle: "Stil",
  key: (n) => `Schlüsselbild ${n}`,
  add: "Schlüsselbild hinzufügen",
  remove: "Schlüsselbild entfernen",
  separation: "Abstand der Füße in Gehrichtung, cm",
  height: "in der Höhe, cm",
  pass: "Durchgang",
  error: "Fehler, °",
  time: "Zeit des Zyklus, s",
  at: (updates, pass, error) => `${counted(updates, "Schritt", "Schritte")} · Durchgang ${pass} · Fehler ${error}°`,
  learned: (pass, error) => `Durchgang ${pass}: ${error}°`,
  unlearned: "vor dem ersten Durchgang",
  dragged: (change, error) => `größte Änderung ${change}° je Bild · Fehler ${error}°`,
  keyed: (count, error) => `${counted(count, "Schlüsselbild", "Schlüsselbilder")} · Fehler ${error}°`,
  stepped: (updates, count, error) =>
    `Nach ${counted(updates, "Schritt", "Schritten")} von ${count} Komponenten ist der Fehler dieses Durchgangs ${error}°.`,
  fallen: (pass, error) => `Nach Durchgang ${pass} liegt das Modell im Mittel um ${error}° daneben.`,
  asked: (separation, height) => `Die Füße sind in Gehrichtung ${separation} cm auseinander, in der Höhe ${height} cm.`,
  interpolated: (count, error, from, to, worst) =>
    `Mit ${counted(count, "Schlüsselbild", "Schlüsselbildern")} liegt der Zyklus im Mittel um ${error}° daneben, am meisten zwischen ${from} und ${to} s, um ${worst}°.`,
  pose: "Pose",
  sampled: "Stichprobe x",
  predicted: "Vorhersage Zv",
  predictedOff: (degrees) => `Die Vorhersage Zv liegt im Mittel der Gelenke ${degrees}° neben der Stichprobe x.`,
  noUpdate: "Mach einen Lernschritt, um hier seine Stichprobe zu sehen.",
  components: ["Komponente", "Anteil a", "r", "m, cm"],
  passes: ["Durchgang", "Fehler, °"],
  variables: ["Variable", "cm"],
  frames: ["Zeit, s", "Abstand, cm", "Fehler, °"],
};
