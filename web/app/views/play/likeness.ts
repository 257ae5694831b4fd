/** How like the database's clips an input is as a whole, and what is said of that. Pure. */
import type { Analysis, DatabaseInfo, InputInfo, Reading } from "../../../client/protocol";
import { createWorldPose, POSE_FLOATS, ROLES, worldFromLocal } from "../../../humanoid";

/**
 * Weight below which no class is the one that an input is like: nearly all are alike then. Recorded walks have .1 to .8 with
 * the built-in database, other recordings of its actions .06 to .3.
 */
const LEAST_CLASS = 0.1;
/** Share of an action from which an input is of that action, though of none of its styles: recorded runs have .3 to .6. */
const LEAST_ACTION = 0.5;

/** The joints by which somebody is seen to move. */
const SEEN = (["hips", "head", "left_hand", "right_hand", "left_foot", "right_foot"] as const).map((role) =>
  ROLES.indexOf(role),
);
/** Speed below which somebody stands still though breathing and swaying, metres a second. */
const STILL = 0.25;
/** Share of a clip in which a person who stands still may be faster. */
const EXCEPT = 0.05;
/** Time over which speeds are measured, seconds: noise of the recording does not count. */
const SPAN_SECS = 0.2;

/** What an input is like. */
export interface Likeness {
  /**
   * `class`: like one; `action`: of an action, but in none of its styles. The others are unlike anything: all classes are
   * nearly `alike`, all poses are `far`, or nobody moves, as in no clip of the database (`still`).
   */
  kind: "class" | "action" | "alike" | "far" | "still";
  /** The class with the largest mean weight; of an action, the action's share and the style with most of it. */
  read: Reading;
  /** Mean distance of its poses from the nearest of the database, centimetres, where it is `far`. */
  centimetres?: number;
}

/** Whether an input is unlike anything in the styles. */
export const isUnlike = ({ kind }: Likeness): boolean => kind !== "class" && kind !== "action";

/**
 * What an input is like, from the classes of all its frames.
 * @param allMove whether in every clip of the database somebody moves: then an input in which nobody does is like none
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

/** Whether a class of a frame has so little weight that the input is not like it. */
export const isFaint = ({ weight }: Reading): boolean => weight < LEAST_CLASS;

function meanWeights(classWeights: Float32Array, classes: number): Float64Array {
  const sums = new Float64Array(classes);
  for (let i = 0; i < classWeights.length; i++) sums[i % classes]! += classWeights[i]!;
  const frames = Math.max(1, classWeights.length / Math.max(1, classes));
  return sums.map((sum) => sum / frames);
}

/** Whether nobody moves in nearly all of a clip. */
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
