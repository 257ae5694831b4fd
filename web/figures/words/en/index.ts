/** Figures in English. */
import { ROLES, type Role } from "../../../humanoid";
import { INPUTS, STYLES } from "../../built_in";
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

const same = <T extends string>(names: readonly T[], say: (name: T) => string) =>
  Object.fromEntries(names.map((name) => [name, say(name)])) as Record<T, string>;

/** `left_upper_arm` as “upper arm L”. */
const joint = (role: Role) =>
  role.replace(/^(left|right)_(.*)$/, (_, side, part) => `${part} ${side[0].toUpperCase()}`);

export const en = {
  decimal: ".",
  number: "number",
  loading: "The figure is loading.",
  table: "As a table",
  play: "Play",
  pause: "Pause",
  noGraphics: "This browser cannot draw in 3D. The table below has the same data.",
  failed: (why: string) => `The figure could not be created. ${why}`,
  retry: "Try again",
  unknown: (kind: string) => `There is no figure “${kind}”.`,
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
  distance: (joint: string) => `Distance of the joint: ${joint}`,
  legend: (pairing: string, now: string, mean: string) => `${pairing}: ${now} cm, mean ${mean} cm`,
  two: "Two walkers, one content",
  ended: "The styled walker has already finished.",
  times: (input: string, style: string, styled: string) => `neutral ${input}\u00a0s, ${style} ${styled}\u00a0s`,
  pictured: (style: string, time: string, pairing: string, e: string, most: string, cm: string) =>
    `At ${time} s, ${pairing}: the ${style} pose differs by ${e} cm from the neutral one, most at the ${most}, ${cm} cm.`,
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
  curved: (style: string, time: string, content: string, second: string, mean: string, meanSecond: string) =>
    `Style ${style} at ${time} s: ${content} cm by content, ${second} cm by second. Means ${mean} and ${meanSecond} cm.`,
} as const;
