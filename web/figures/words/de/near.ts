/** Figures of the distance of windows in German. */
import type { Words } from "../words";

export const near: Words["near"] = {
  stage: "Die Anfrage und ihre 8 nächsten",
  title: "Abstand zu jedem Fenster",
  knobs: {
    heading: { symbol: "drehen", name: "Drehung", description: "Dreht die ganze Anfrage um die Senkrechte, Grad." },
    x: {
      symbol: "x",
      name: "Verschiebung x",
      description: "Verschiebt die ganze Anfrage auf dem Boden längs x, Meter.",
    },
    z: {
      symbol: "z",
      name: "Verschiebung z",
      description: "Verschiebt die ganze Anfrage auf dem Boden längs z, Meter.",
    },
    k: { symbol: "K", name: "Nachbarn K", description: "Wie viele der nächsten Fenster benutzt werden." },
  },
  move: "Position der Anfrage",
  moved: (x, z) => `x ${x} m, z ${z} m`,
  restore: "Zurücksetzen",
  window: "Bilder s eines Fensters",
  reversed: "Zeit umkehren",
  guess: "√D₁ änderte sich um, mm",
  query: "Anfrage",
  rows: "Zeit des Beispiels, s",
  distance: "√D, mm",
  read: (first, k, last) => `√D₁ ${first} mm · √D von Nummer ${k}: ${last} mm`,
  said: (window, reversed, first, k, last) =>
    `Fenster aus ${window} ${window === "1" ? "Bild" : "Bildern"}${reversed ? ", die Zeit der Anfrage umgekehrt" : ""}: Das nächste ist ${first} mm entfernt, Nummer ${k} ${last} mm.`,
  posed: (heading, x, z, limbs, first) =>
    `Die Anfrage ist um ${heading}° gedreht und um ${x} m und ${z} m verschoben, ${limbs === "1" ? "1 Glied ist" : `${limbs} Glieder sind`} gebeugt. Das nächste Beispiel ist ${first} mm entfernt.`,
  columns: ["Zeile", "√D, mm", "θ"],
};
