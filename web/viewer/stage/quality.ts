/** Adaptive quality: fewer pixels and samples if frames are too slow. */

import type { Shading } from "../light/shading";
import type { ShadowTaps } from "../light/soft_shadow";

/** Settings of a level of quality. */
export interface QualityLevel {
  /** Pixels of the picture. The pixel ratio follows from it, so that a small picture stays sharp. */
  pixels: number;
  /** Side of the light's shadow map, texels. */
  shadowSize: number;
  /** Side of the ground's shade map, texels. */
  shadeSize: number;
  taps: ShadowTaps;
  /** Detail of the mannequins' geometry, at most 1. */
  detail: number;
  shading: Shading;
  /** Frames per second below which the next level is tried. */
  slowest: number;
}

/** Levels from the best to the cheapest. */
export const QUALITY_LEVELS: readonly QualityLevel[] = [
  level(8e6, 1024, 640, { search: 16, filter: 32 }, 1, "physical", 45),
  level(2e6, 1024, 512, { search: 12, filter: 20 }, 1, "physical", 45),
  level(8e5, 512, 192, { search: 8, filter: 16 }, 0.6, "matt", 24),
  level(4.5e5, 512, 160, { search: 6, filter: 10 }, 0.5, "matt", 20),
  level(2.5e5, 512, 128, { search: 6, filter: 8 }, 0.5, "matt", 22),
  level(1.8e5, 512, 128, { search: 6, filter: 8 }, 0.5, "matt", 0),
];

/** Largest pixel ratio; more is not visible. */
const MAX_RATIO = 2;
/** Samples per screen pixel, along a side, of a still picture. */
const STILL_SAMPLES = 2;
/** Factor on the pixels of a still picture. */
const STILL_FACTOR = 4;
/** Frames per second that allow a better level to be tried. */
const FAST = 55;
/** Length of one measurement, seconds. */
const WINDOW = 0.5;
/** Measurements that are ignored while a page is loading: drawing is slow then at any quality. */
const WHILE_LOADING = 6;
/** Consecutive slow measurements that lower the quality; a single one may be caused by other work of the page. */
const SLOW_TO_LOWER = 3;
/** Consecutive fast measurements that raise it, initially. */
const FAST_TO_RAISE = 10;
/** Factor on that number after a level proved too slow again. */
const BACKOFF = 4;
/** A longer pause between frames means a hidden tab, not a slow one, seconds. */
const PAUSE = 0.9;

function level(
  pixels: number,
  shadowSize: number,
  shadeSize: number,
  taps: ShadowTaps,
  detail: number,
  shading: Shading,
  slowest: number,
): QualityLevel {
  return { pixels, shadowSize, shadeSize, taps, detail, shading, slowest };
}

/** Pixel ratio of a picture of `area` CSS pixels on a screen with ratio `screen`; a still picture may take longer. */
export function pixelRatio({ pixels }: QualityLevel, area: number, screen: number, still: boolean): number {
  const affordable = Math.sqrt((pixels * (still ? STILL_FACTOR : 1)) / Math.max(1, area));
  return Math.min(still ? STILL_SAMPLES * screen : screen, MAX_RATIO, affordable);
}

/** Counts frames, reports their rate, and chooses the level of quality. */
export class QualityGovernor {
  /** Called after each measurement. */
  onFps: ((fps: number) => void) | undefined;
  readonly #best: number;
  #level: number;
  #undecided: number;
  #elapsed = 0;
  #frames = 0;
  #slow = 0;
  #fast = 0;
  #fastToRaise = FAST_TO_RAISE;
  #raised = false;

  /** Starts at a level, which is the best one that will be used; 0 is the best. */
  constructor(best = 0, { isLoading = false } = {}) {
    this.#best = best;
    this.#level = best;
    this.#undecided = isLoading ? WHILE_LOADING : 0;
  }

  /** The current level. */
  get level(): number {
    return this.#level;
  }

  /** Adds the time since the last frame. Returns whether the level has changed. */
  frame(dtSecs: number): boolean {
    if (dtSecs <= 0) return false;
    if (dtSecs > PAUSE) {
      this.#elapsed = 0;
      this.#frames = 0;
      return false;
    }
    this.#elapsed += dtSecs;
    this.#frames++;
    if (this.#elapsed < WINDOW) return false;
    const fps = this.#frames / this.#elapsed;
    this.#elapsed = 0;
    this.#frames = 0;
    this.onFps?.(fps);
    return this.#judge(fps);
  }

  #judge(fps: number): boolean {
    if (this.#undecided > 0) {
      this.#undecided--;
      return false;
    }
    this.#slow = fps < QUALITY_LEVELS[this.#level]!.slowest ? this.#slow + 1 : 0;
    this.#fast = fps > FAST ? this.#fast + 1 : 0;
    if (this.#slow >= SLOW_TO_LOWER && this.#level < QUALITY_LEVELS.length - 1) {
      if (this.#raised) this.#fastToRaise *= BACKOFF;
      return this.#move(1);
    }
    if (this.#fast >= this.#fastToRaise && this.#level > this.#best) return this.#move(-1);
    return false;
  }

  #move(by: 1 | -1): boolean {
    this.#level += by;
    this.#raised = by < 0;
    this.#slow = 0;
    this.#fast = 0;
    return true;
  }
}
