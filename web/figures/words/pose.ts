/** Texts of the figures of the degrees of freedom of a pose. */
import type { KnobWords } from "./knob";

export interface PoseWords {
  /** Titles of the stage, of the cells and of the curves. */
  stage: string;
  numbers: string;
  title: string;
  knobs: Record<"x" | "y" | "z" | "heading" | "phi", KnobWords>;
  restore: string;
  pose: string;
  /** Name of the three cells of a joint, with their unit. */
  angles: (joint: string) => string;
  /** Names of the last four cells. */
  height: string;
  sideways: string;
  forwards: string;
  turning: string;
  /** Axes of the curves. */
  time: string;
  flexion: (joint: string) => string;
  /** Names of the curves. */
  raw: string;
  centred: string;
  read: (angle: string) => string;
  counted: (changed: string, of: string) => string;
  jumps: (raw: string, jump: string) => string;
  posed: (joint: string, angle: string, x: string, y: string, z: string) => string;
  listed: (changed: string, of: string, heading: string, limbs: string) => string;
  plotted: (joint: string, phi: string, raw: string, jump: string) => string;
  /** Headers of the tables: joint and components of w; time and both values. */
  components: readonly [string, string, string, string];
  columns: readonly [string, string, string];
}
