/** Positions of the planner's rows and steps, units. */
import type { Scale } from "../../../ui/scale";
import type { PlannedWalk } from "./plan_walker";

/** Width left of the rows, for their names, and right of them. */
export const GUTTER = 88;
export const MARGIN = 20;
/** Distances from the top. */
export const ROWS = {
  ruler: 22,
  caption: 38,
  style: 46,
  steps: 110,
  numbers: 140,
  heading: 166,
  chart: 184,
  height: 284,
};
export const STYLE_HEIGHT = 40;
export const CHART_HEIGHT = 92;
const MIN_WIDTH = 320;

export interface PlannerLayout {
  width: number;
  /** Scale of the plan's time, seconds. */
  time: Scale;
  /** Start of each step, and end of the last one. */
  stepX: number[];
  /** Mean width of a step. */
  stepWidth: number;
}

export function layOutPlanner(width: number, { frames, rateHz, stepStarts }: PlannedWalk): PlannerLayout {
  const used = Math.max(MIN_WIDTH, width);
  const time = { min: 0, max: frames / rateHz, from: GUTTER, to: used - MARGIN };
  const extent = time.to - time.from;
  return {
    width: used,
    time,
    stepX: stepStarts.map((frame) => time.from + (frame / frames) * extent),
    stepWidth: extent / Math.max(1, stepStarts.length - 1),
  };
}
