/** Texts of the figures of a registered step. */
import type { PathName } from "../warp/warp_state";

export interface WarpWords {
  title: string;
  paths: Record<PathName, string>;
  /** The path that is read. */
  path: string;
  /** Axes: time of the neutral step, and of the style's. */
  neutral: string;
  styled: (style: string) => string;
  anchor: (n: number) => string;
  place: (x: string, y: string) => string;
  /** Texts about paths, and about each: its cost, and its distance from the exact one. */
  lead: readonly [cost: string, off: string];
  cost: (ratio: string) => string;
  off: (ms: string) => string;
  /** Left and right, as letters next to the bars. */
  sides: readonly [left: string, right: string];
  feet: { both: string; left: string; right: string; none: string };
  said: (path: string, time: string, tau: string, cost: string, neutral: string, style: string, feet: string) => string;
  walkers: string;
  /** Headers of the table: style, time, feet. */
  columns: readonly [string, string, string];
  paired: (time: string, neutral: string, tau: string, style: string, feet: string) => string;
}
