/** The common clock of all columns. Pure functions. */
import type { FrameRange } from "../../../client/protocol";

/** Settings of the clock. */
export interface Running {
  speed: number;
  rateHz: number;
  frames: number;
  range: FrameRange | undefined;
  loop: boolean;
}

/** Position of the clock after a step. */
interface Advanced {
  /** Fractional input frame. */
  frame: number;
  /** Whether it returned to the first frame, or stopped at the last. */
  event: "restarted" | "ended" | undefined;
}

/** The clock after `dt` seconds from a fractional input frame. */
export function advanced(frame: number, dt: number, { speed, rateHz, frames, range, loop }: Running): Advanced {
  const last = Math.min(range?.last ?? frames - 1, frames - 1);
  const next = frame + dt * speed * rateHz;
  if (next < last) return { frame: next, event: undefined };
  return loop ? { frame: range?.first ?? 0, event: "restarted" } : { frame: last, event: "ended" };
}
