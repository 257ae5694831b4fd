/** Figures in English. */
import { ROLES, type Role } from "../../humanoid";
import { INPUTS, STYLES } from "./built_in";
import type { Words } from "./words";

const same = <T extends string>(names: readonly T[], say: (name: T) => string) =>
  Object.fromEntries(names.map((name) => [name, say(name)])) as Record<T, string>;

/** `left_upper_arm` as “upper arm L”. */
const joint = (role: Role) =>
  role.replace(/^(left|right)_(.*)$/, (_, side, part) => `${part} ${side[0].toUpperCase()}`);

export const en: Words = {
  decimal: ".",
  loading: "The figure is loading.",
  table: "As a table",
  play: "Play",
  pause: "Pause",
  noGraphics: "This browser cannot draw in 3-D. The table below says the same.",
  failed: (why) => `The figure could not be made. ${why}`,
  unknown: (kind) => `There is no figure “${kind}”.`,
  styles: same(STYLES, (name) => name),
  inputs: same(INPUTS, (name) => name),
  joints: same(ROLES, (role) => joint(role).replaceAll("_", " ")),
  style: "Style",
  pairing: "Which instants are compared",
  second: "same second",
  content: "same content",
  joint: "Joint",
  allJoints: "all joints, mean",
  playhead: "Instant",
  time: "time of the input, s",
  difference: "Difference of the poses, e",
  distance: (joint) => `Distance of the joint: ${joint}`,
  legend: (pairing, now, mean) => `${pairing}: ${now} cm, mean ${mean} cm`,
  two: "Two walkers, one content",
  ended: "The styled walker has arrived already.",
  times: (input, style, styled) => `neutral ${input}\u00a0s, ${style} ${styled}\u00a0s`,
  pictured: (style, time, pairing, e, most, cm) =>
    `At ${time} s, ${pairing}: the ${style} pose differs by ${e} cm from the neutral one, most at the ${most}, ${cm} cm.`,
  line: {
    title: "One degree of freedom, and its line",
    knobs: {
      k: { symbol: "K", name: "Neighbours K", description: "How many of the nearest examples count" },
      lambda: { symbol: "λ", name: "Ridge λ", description: "How much a steep line costs" },
      noise: { symbol: "ν", name: "Noise ν, degrees", description: "Noise that is added to the targets" },
    },
    taper: "Nearer examples count more",
    input: (name) => `${name}, input`,
    output: (name, style) => `${name}, ${style}`,
    columns: ["row", "input x, °", "target y, °", "weight v"],
    read: (mean, above) => `mean ${mean}°, prediction ${above}° from it`,
    said: (name, k, x, y, slope, above) =>
      `${name}: ${k} examples; at an input of ${x}° the line predicts ${y}°, slope ${slope}, ${above}° from their mean.`,
  },
  mix: {
    title: "The nearest classes",
    reading: "What the input is read as",
    delta: { symbol: "δ", name: "Width δ", description: "How slowly a weight falls with the distance" },
    weight: "weight λ",
    actions: { walk: "walk", run: "run", jump: "jump", punch: "punch", kick: "kick" },
    guess: "Weight of the first of two",
    columns: ["class", "D, cm²", "λ"],
    class: (name, square, weight) => `${name} at ${square} cm², weight ${weight}`,
    nearest: (classes) => `The nearest classes: ${classes}.`,
    readAs: (time, actions) => `At ${time} s: ${actions}.`,
  },
  sweep: {
    title: "Error over the ridge",
    error: "error, °",
    columns: ["λ", "error, °"],
    read: (error, least, best) => `error ${error}°; least ${least}° at λ ${best}`,
    said: (lambda, error, least, best) =>
      `At λ ${lambda} the prediction of the whole walk is off by ${error}°; the least is ${least}° at λ ${best}.`,
  },
  curved: (style, time, content, second, mean, meanSecond) =>
    `Style ${style} at ${time} s: ${content} cm by content, ${second} cm by second. Means ${mean} and ${meanSecond} cm.`,
};
