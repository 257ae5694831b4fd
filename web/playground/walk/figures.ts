/** What is measured of a walk. */
import { POSE_FLOATS } from "../../viewer";
import type { Walked } from "./walking";

/** What is measured of a block. */
export interface BlockFigures {
  /** Steps a minute. */
  cadence: number;
  /** Metres. */
  stepLength: number;
  /** Metres a second. */
  speed: number;
}

/** What a block's own steps measure. */
export function figuresOf({ segments, begins, durations, poses, rateHz }: Walked, block: number): BlockFigures {
  const { first, steps } = segments.find((s) => s.kind === "block" && s.block === block)!;
  const [from, to] = [begins[first]!, Math.min(begins[first + steps]!, begins.at(-1)! - 1)];
  // By what the model wants: the frames of a step are whole, and the walk's first ones are not shown.
  const secs = durations
    .slice(first, first + steps)
    .flat()
    .reduce((sum, state) => sum + state, 0);
  const at = (frame: number, axis: number) => poses[frame * POSE_FLOATS + axis]!;
  let way = 0;
  for (let frame = from; frame < to; frame++)
    way += Math.hypot(at(frame + 1, 0) - at(frame, 0), at(frame + 1, 2) - at(frame, 2));
  const speed = way / Math.max(1 / rateHz, (to - from) / rateHz);
  return { cadence: (60 * steps) / secs, stepLength: (speed * secs) / steps, speed };
}
