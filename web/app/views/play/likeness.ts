/** Similarity of a whole input to the database's clips, and the text about it. Pure functions. */
import type { Analysis, DatabaseInfo, InputInfo, Reading } from "../../../client/protocol";
import { createWorldPose, POSE_FLOATS, ROLES, worldFromLocal } from "../../../humanoid";

/**
 * Weight below which an input does not belong to a class, since nearly all are then equally similar. Recorded walks
 * have 0.1 to 0.8 with the built-in database, other recordings of its actions 0.06 to 0.3.
 */
const LEAST_CLASS = 0.1;
/**
 * Share of an action from which an input belongs to that action, although to none of its styles: recorded runs have 0.3
 * to 0.6.
 */
const LEAST_ACTION = 0.5;

/** The joints whose movement is measured. */
const SEEN = (["hips", "head", "left_hand", "right_hand", "left_foot", "right_foot"] as const).map((role) =>
  ROLES.indexOf(role),
);
/** Speed below which a body counts as still, despite breathing and swaying, metres per second. */
const STILL = 0.25;
/** Share of a clip in which a still body may be faster. */
const EXCEPT = 0.05;
/** Time over which speeds are measured, seconds, which averages the noise of the recording. */
const SPAN_SECS = 0.2;

/** Result of the recognition. */
export interface Likeness {
  /**
   * `class`: similar to one class; `action`: of an action, but in none of its styles. The others are not similar to any
   * class: all classes are nearly equally similar (`alike`), all poses are far away (`far`), or the body does not move,
   * unlike in all clips of the database (`still`).
   */
  kind: "class" | "action" | "alike" | "far" | "still";
  /** The class with the largest mean weight; of an action, the action's share and its heaviest style. */
  read: Reading;
  /** Mean distance of its poses from the nearest ones of the database, centimetres, if it is `far`. */
  centimetres?: number;
}

/** Whether an input is not similar to any class. */
export const isUnlike = ({ kind }: Likeness): boolean => kind !== "class" && kind !== "action";

/**
 * Recognises an input from the classes of all its frames.
 * @param allMove whether the body moves in every clip of the database: then an input without movement is not similar to
 * any
 */
export function likenessOf(
  input: Pick<InputInfo, "poses">,
  { classWeights, notes, distanceMetres }: Pick<Analysis, "classWeights" | "notes" | "distanceMetres">,
  { classes, proportions, rateHz }: Pick<DatabaseInfo, "classes" | "proportions" | "rateHz">,
  allMove: boolean,
): Likeness | undefined {
  const weights = meanWeights(classWeights, classes.length);
  let best = -1;
  for (const [i, weight] of weights.entries()) if (weight > (weights[best] ?? 0)) best = i;
  const heaviest = classes[best];
  if (!heaviest) return undefined;
  const read = { action: heaviest.action, style: heaviest.style, weight: weights[best]! };
  if (distanceMetres !== undefined && notes.some(({ code }) => code === "unfamiliar"))
    return { kind: "far", read, centimetres: Math.round(100 * distanceMetres) };
  if (allMove && standsStill(input.poses, proportions, rateHz)) return { kind: "still", read };
  if (read.weight >= LEAST_CLASS) return { kind: "class", read };
  const shares = new Map<string, number>();
  for (const [i, { action }] of classes.entries()) shares.set(action, (shares.get(action) ?? 0) + weights[i]!);
  const [action, share] = [...shares].reduce((a, b) => (b[1] > a[1] ? b : a));
  return share >= LEAST_ACTION ? { kind: "action", read: { ...read, action, weight: share } } : { kind: "alike", read };
}

/** Whether the weight of a frame's class is too small to be meaningful. */
export const isFaint = ({ weight }: Reading): boolean => weight < LEAST_CLASS;

function meanWeights(classWeights: Float32Array, classes: number): Float64Array {
  const sums = new Float64Array(classes);
  for (let i = 0; i < classWeights.length; i++) sums[i % classes]! += classWeights[i]!;
  const frames = Math.max(1, classWeights.length / Math.max(1, classes));
  return sums.map((sum) => sum / frames);
}

/** Whether the body does not move in nearly all of a clip. */
function standsStill(poses: Float32Array, proportions: Float32Array, rateHz: number): boolean {
  const step = Math.max(1, Math.round(SPAN_SECS * rateHz));
  const world = createWorldPose();
  let before: number[] | undefined;
  let [moving, all] = [0, 0];
  for (let first = 0; first + POSE_FLOATS <= poses.length; first += step * POSE_FLOATS) {
    worldFromLocal(proportions, poses.subarray(first, first + POSE_FLOATS), world);
    const now = SEEN.flatMap((joint) => [...world.positions.subarray(3 * joint, 3 * joint + 3)]);
    if (before) {
      const last = before;
      const moved = SEEN.map((_, i) => {
        const [x, y, z] = [0, 1, 2].map((k) => now[3 * i + k]! - last[3 * i + k]!) as [number, number, number];
        return Math.hypot(x, y, z);
      });
      all += 1;
      if (Math.max(...moved) > (STILL * step) / rateHz) moving += 1;
    }
    before = now;
  }
  return all > 0 && moving <= EXCEPT * all;
}
