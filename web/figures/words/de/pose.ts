/** Figures of the degrees of freedom of a pose in German. */
import type { Words } from "../words";

export const pose: Words["pose"] = {
  stage: "Gelenk und Mittel",
  numbers: "Die 67 Zahlen dieser Pose",
  title: "Eine Zahl über der Zeit",
  knobs: {
    x: { symbol: "w x", name: "w um x", description: "Dreht das Gelenk von seinem Mittel weg um seine x-Achse, Grad." },
    y: { symbol: "w y", name: "w um y", description: "Dreht das Gelenk von seinem Mittel weg um seine y-Achse, Grad." },
    z: { symbol: "w z", name: "w um z", description: "Dreht das Gelenk von seinem Mittel weg um seine z-Achse, Grad." },
    heading: {
      symbol: "drehen",
      name: "Figur drehen",
      description: "Dreht den ganzen Gang um die Senkrechte, Grad.",
    },
    phi: {
      symbol: "φ",
      name: "Eigene Achsen φ",
      description: "Dreht die eigenen Achsen des Gelenks um x, Grad. Sie sind eine Konvention jedes Skeletts.",
    },
  },
  restore: "Zurücksetzen",
  pose: "Pose",
  angles: (joint) => `${joint}, °`,
  height: "h, m",
  sideways: "v nach links, m/s",
  forwards: "v vorwärts, m/s",
  turning: "ψ̇, °/s",
  time: "Zeit, s",
  flexion: (joint) => `${joint}, um x, °`,
  raw: "log R",
  centred: "w",
  read: (angle) => `|w| ${angle}°`,
  counted: (changed, of) => `${changed} von ${of} geändert`,
  jumps: (raw, jump) => `größter Sprung: log R ${raw} rad · w ${jump} rad`,
  posed: (joint, angle, x, y, z) => `${joint}: ${angle}° vom Mittel gedreht, ${x}° um x, ${y}° um y, ${z}° um z.`,
  listed: (changed, of, heading, limbs) =>
    `Die Figur ist um ${heading}° gedreht, ${limbs === "1" ? "1 Glied ist" : `${limbs} Glieder sind`} gebeugt: ${changed} von ${of} Zahlen sind anders als die der Eingabe.`,
  plotted: (joint, phi, raw, jump) =>
    `${joint}, die eigenen Achsen um ${phi}° gedreht: Von Bild zu Bild springt log R um höchstens ${raw} rad, w um ${jump} rad.`,
  components: ["Gelenk", "x, °", "y, °", "z, °"],
  columns: ["Zeit, s", "log R, °", "w, °"],
};
