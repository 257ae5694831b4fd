/** Figures of the degrees of freedom of a pose in English. */
import type { PoseWords } from "../pose";

export const pose: PoseWords = {
  stage: "Joint and mean",
  numbers: "The 67 numbers of this pose",
  title: "One number over time",
  knobs: {
    x: { symbol: "w x", name: "w about x", description: "Turns the joint from its mean about its x axis, degrees." },
    y: { symbol: "w y", name: "w about y", description: "Turns the joint from its mean about its y axis, degrees." },
    z: { symbol: "w z", name: "w about z", description: "Turns the joint from its mean about its z axis, degrees." },
    heading: {
      symbol: "turn",
      name: "Turn the walker",
      description: "Turns the whole walk about the vertical, degrees.",
    },
    phi: {
      symbol: "φ",
      name: "Own axes φ",
      description: "Turns the joint's own axes about x, degrees. They are a convention of each skeleton.",
    },
  },
  restore: "Put back",
  pose: "pose",
  angles: (joint) => `${joint}, °`,
  height: "h, m",
  sideways: "v to the left, m/s",
  forwards: "v forwards, m/s",
  turning: "ψ̇, °/s",
  time: "time, s",
  flexion: (joint) => `${joint}, about x, °`,
  raw: "log R",
  centred: "w",
  read: (angle) => `|w| ${angle}°`,
  counted: (changed, of) => `${changed} of ${of} changed`,
  jumps: (raw, jump) => `greatest jump: log R ${raw} rad · w ${jump} rad`,
  posed: (joint, angle, x, y, z) =>
    `The ${joint} is turned by ${angle}° from its mean: ${x}° about x, ${y}° about y, ${z}° about z.`,
  listed: (changed, of, heading, limbs) =>
    `With the walker turned by ${heading}° and ${limbs} ${limbs === "1" ? "limb" : "limbs"} bent, ${changed} of ${of} numbers differ from the input's.`,
  plotted: (joint, phi, raw, jump) =>
    `The ${joint} with its own axes turned by ${phi}°: from frame to frame log R jumps by ${raw} rad at most, w by ${jump} rad.`,
  components: ["joint", "x, °", "y, °", "z, °"],
  columns: ["time, s", "log R, °", "w, °"],
};
