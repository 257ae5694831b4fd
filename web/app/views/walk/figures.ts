/** Cadence, step length and speed of a block. */
import { POSE_FLOATS } from "../../../humanoid";
import type { PlannedWalk } from "./plan_walker";

/** Measurements of one block. */
export interface BlockFigures {
  /** Steps per minute. */
  cadence: number;
  /** Metres. */
  stepLength: number;
  /** Metres per second. */
  speed: number;
}

/** The measurements of a block's own steps, without the transitions. */
export function figuresOf(
  { segments, stepStarts, stateSecs, poses, rateHz }: PlannedWalk,
  block: number,
): BlockFigures {
  const { first, steps } = segments.find((s) => s.kind === "block" && s.block === block)!;
  const [from, to] = [stepStarts[first]!, Math.min(stepStarts[first + steps]!, stepStarts.at(-1)! - 1)];
  // The model's durations, because frame counts are rounded, and the walk's first frames are not representative.
  const secs = stateSecs
    .slice(first, first + steps)
    .flat()
    .reduce((sum, state) => sum + state, 0);
  const at = (frame: number, axis: number) => poses[frame * POSE_FLOATS + axis]!;
  let distance = 0;
  for (let frame = from; frame < to; frame++)
    distance += Math.hypot(at(frame + 1, 0) - at(frame, 0), at(frame + 1, 2) - at(frame, 2));
  const speed = distance / Math.max(1 / rateHz, (to - from) / rateHz);
  return { cadence: (60 * steps) / secs, stepLength: (speed * secs) / steps, speed };
}
