/** Adaptive quality: fewer pixels and samples where frames come too slowly. */

import type { Shading } from "../mannequin/materials";
import type { ShadowTaps } from "./soft_shadow";

/** What a level of quality means. */
export interface QualityLevel {
  /** Upper limit of the pixel ratio. */
  pixelRatio: number;
  /** Side of the shadow map, texels. */
  shadowSize: number;
  /** Side of the ground's shade map, texels. */
  shadeSize: number;
  taps: ShadowTaps;
  /** Detail of the mannequins' geometry, at most 1. */
  detail: number;
  shading: Shading;
}

/** Levels from the best to the cheapest. */
export const QUALITY_LEVELS: readonly QualityLevel[] = [
  { pixelRatio: 2, shadowSize: 1024, shadeSize: 640, taps: { search: 16, filter: 24 }, detail: 1, shading: "physical" },
  {
    pixelRatio: 1.5,
    shadowSize: 1024,
    shadeSize: 512,
    taps: { search: 12, filter: 20 },
    detail: 1,
    shading: "physical",
  },
  { pixelRatio: 1, shadowSize: 512, shadeSize: 192, taps: { search: 8, filter: 16 }, detail: 0.6, shading: "matt" },
  { pixelRatio: 0.75, shadowSize: 512, shadeSize: 128, taps: { search: 6, filter: 10 }, detail: 0.5, shading: "matt" },
];

/** Frames a second below which quality is lowered. */
const TOO_SLOW = 42;
/** Length of one measurement, seconds. */
const WINDOW = 0.5;
/** Slow measurements in a row that lower the quality; one alone may be the page being busy. */
const PATIENCE = 3;
/** A longer pause between frames is a hidden tab, not a slow one, seconds. */
const PAUSE = 0.6;

/** Counts frames, reports their rate, and decides when to lower the quality. */
export class QualityGovernor {
  /** Called after each measurement. */
  onFps: ((fps: number) => void) | undefined;
  #level: number;
  #elapsed = 0;
  #frames = 0;
  #slow = 0;

  /** Starts at a level, 0 being the best. */
  constructor(level = 0) {
    this.#level = level;
  }

  /** The level in force. */
  get level(): number {
    return this.#level;
  }

  /** Takes the time since the last frame; returns whether the level has changed. */
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
    this.#slow = fps < TOO_SLOW ? this.#slow + 1 : 0;
    if (this.#slow < PATIENCE || this.#level >= QUALITY_LEVELS.length - 1) return false;
    this.#slow = 0;
    this.#level++;
    return true;
  }
}
