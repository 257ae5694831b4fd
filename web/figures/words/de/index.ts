/** Figures in German. */
import type { Words } from "../words";
import { bias } from "./bias";
import { chain } from "./chain";
import { feet } from "./feet";
import { judge } from "./judge";
import { line, sweep } from "./line";
import { map } from "./map";
import { mix } from "./mix";
import { near } from "./near";
import { pace } from "./pace";
import { pose } from "./pose";
import { warp } from "./warp";

export const de: Words = {
  decimal: ",",
  number: "Zahl",
  loading: "Die Abbildung wird geladen.",
  table: "Als Tabelle",
  play: "Abspielen",
  pause: "Anhalten",
  noGraphics: "Dieser Browser kann nicht in 3D zeichnen. Die Tabelle darunter enthält dieselben Daten.",
  failed: (why) => `Die Abbildung konnte nicht gezeichnet werden. ${why}`,
  retry: "Erneut versuchen",
  unknown: (kind) => `Es gibt keine Abbildung „${kind}“.`,
  styles: {
    neutral: "neutral",
    angry: "wütend",
    childlike: "kindlich",
    depressed: "bedrückt",
    old: "alt",
    proud: "stolz",
    sexy: "sexy",
    strutting: "stolzierend",
  },
  inputs: {
    "neutral walk": "neutrales Gehen",
    "neutral walk with turns": "neutrales Gehen mit Kurven",
    "neutral walk in a circle": "neutrales Gehen im Kreis",
    "neutral run": "neutrales Laufen",
    "neutral walk, run and walk": "neutral: Gehen, Laufen, Gehen",
    "neutral run, walk, jump and walk": "neutral: Laufen, Gehen, Sprung, Gehen",
    "neutral walk, punch, kick, jump and walk": "neutral: Gehen, Schlag, Tritt, Sprung, Gehen",
  },
  joints: {
    hips: "Hüfte",
    spine: "Wirbelsäule",
    chest: "Brust",
    neck: "Hals",
    head: "Kopf",
    left_shoulder: "Schulter L",
    left_upper_arm: "Oberarm L",
    left_lower_arm: "Unterarm L",
    left_hand: "Hand L",
    right_shoulder: "Schulter R",
    right_upper_arm: "Oberarm R",
    right_lower_arm: "Unterarm R",
    right_hand: "Hand R",
    left_upper_leg: "Oberschenkel L",
    left_lower_leg: "Unterschenkel L",
    left_foot: "Fuß L",
    left_toes: "Zehen L",
    right_upper_leg: "Oberschenkel R",
    right_lower_leg: "Unterschenkel R",
    right_foot: "Fuß R",
    right_toes: "Zehen R",
  },
  style: "Stil",
  pairing: "Welche Augenblicke verglichen werden",
  second: "gleiche Sekunde",
  content: "gleicher Inhalt",
  joint: "Gelenk",
  allJoints: "alle Gelenke, Mittel",
  playhead: "Augenblick",
  time: "Zeit der Eingabe, s",
  difference: "Unterschied der Posen, e",
  distance: (joint) => `Abstand des Gelenks: ${joint}`,
  legend: (pairing, now, mean) => `${pairing}: ${now} cm, Mittel ${mean} cm`,
  two: "Zwei Figuren, ein Inhalt",
  ended: "Die Figur im Stil ist schon am Ziel.",
  times: (input, style, styled) => `neutral ${input}\u00a0s, ${style} ${styled}\u00a0s`,
  pictured: (style, time, pairing, e, most, cm) =>
    `Bei ${time} s, ${pairing}: Im Stil „${style}“ weicht die Pose um ${e} cm von der neutralen ab, am meisten am Gelenk „${most}“, um ${cm} cm.`,
  chain,
  feet,
  judge,
  line,
  bias,
  map,
  mix,
  near,
  pose,
  pace,
  sweep,
  warp,
  curved: (style, time, content, second, mean, meanSecond) =>
    `Stil „${style}“ bei ${time} s: ${content} cm bei gleichem Inhalt, ${second} cm in der gleichen Sekunde. Mittel ${mean} und ${meanSecond} cm.`,
};
