/** Figures of key-styling in German. */
import type { MapWords } from "../map";

export const map: MapWords = {
  som: "Komponenten und was sie kennen",
  learning: "Fehler nach jedem Durchgang",
  pad: "Zieh die Füße auseinander",
  posed: "Die Pose zu diesen Variablen",
  keys: "Ein Zyklus aus Schlüsseln",
  temperature: { symbol: "T", name: "Temperatur T", description: "Wie weich Komponenten sich eine Pose teilen." },
  steps: { one: "1 Schritt", ten: "10", pass: "Durchgang", all: "alle", restart: "Von vorn" },
  printed: "Vorzeichen wie gedruckt",
  handle: "Stil",
  key: (n) => `Schlüssel ${n}`,
  add: "Schlüssel hinzufügen",
  remove: "Schlüssel entfernen",
  separation: "Abstand der Füße längs des Wegs, cm",
  height: "in der Höhe, cm",
  pass: "Durchgang",
  error: "Fehler, °",
  time: "Zeit des Zyklus, s",
  at: (updates, pass, error) => `${updates} Schritte · Durchgang ${pass} · Fehler ${error} rad`,
  learned: (pass, error) => `Durchgang ${pass}: ${error}°`,
  unlearned: "vor dem ersten Durchgang",
  dragged: (change, error) => `größte Änderung ${change}° je Bild · Fehler ${error}°`,
  keyed: (count, error) => `${count} Schlüssel · Fehler ${error}°`,
  stepped: (updates, count, error) =>
    `Nach ${updates} Schritten von ${count} Komponenten ist der Fehler dieses Durchgangs ${error} rad.`,
  fallen: (pass, error) => `Nach Durchgang ${pass} liegt das Modell im Mittel um ${error}° daneben.`,
  asked: (separation, height) => `Die Füße sind längs des Wegs ${separation} cm auseinander, in der Höhe ${height} cm.`,
  interpolated: (count, error, from, to, worst) =>
    `Mit ${count} Schlüsseln liegt der Zyklus im Mittel um ${error}° daneben, am meisten zwischen ${from} und ${to} s, um ${worst}°.`,
  pose: "Pose",
  components: ["Komponente", "Anteil a", "r", "m, cm"],
  passes: ["Durchgang", "Fehler, °"],
  variables: ["Variable", "cm"],
  frames: ["Zeit, s", "Abstand, cm", "Fehler, °"],
};
