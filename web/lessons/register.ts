/** Lesson: read a warp. */
import type { Measure } from "../figures/kind";
import { measureWarp, mendedFrames } from "../figures/warp/warp_measure";
import { type Anchor, WARP_FIELDS, type WarpState } from "../figures/warp/warp_state";
import { costRatio, moved, ownPath, type Warping, warpingOf } from "../figures/warp/warping";
import { initialOf } from "../link/hash";
import equation from "./equations/register.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(WARP_FIELDS);

/**
 * Exercise A: ratios to the cheapest path's cost that pass, and that are close; distance from the exact path that
 * passes, milliseconds.
 */
const COST = 1.2;
const COST_NEAR = 1.4;
const TRUE = 15;
/** Exercise B: distance from a passing instant, frames. */
const FRAMES_NEAR = 2;
/** A search for a cheap path ends at steps of this share of a step. */
const LEAST_STEP = 0.004;

/** Frames to the nearest instant that passes exercise B. */
const missing = ({ mended, at }: Measure) => Number(mended) - Number(at);
const isPreset = ({ style }: Measure) => style === PRESET.style;

export const register: Lesson = lesson<WarpState>({
  id: "register",
  fields: WARP_FIELDS,
  figures: [
    { name: "warp", kind: "warp", beats: ["bet", "look", "why", "exercises", "sources"] },
    { name: "walkers", kind: "walkers", beats: ["idea", "look", "exercises"] },
  ],
  equation,
  symbols: ["c", "s", "tau", "alpha", "beta"],
  bet: {
    options: ["true", "straight"],
    reveal: async (engine) => {
      const { offDtw, offLinear } = await measureWarp(engine, PRESET);
      const answer = Number(offDtw) <= Number(offLinear) ? "true" : "straight";
      return { answer, measure: { dtw: offDtw!, linear: offLinear! } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "warp",
      start: { ...PRESET, path: "own" },
      pass: (measure) => isPreset(measure) && Number(measure.cost) <= COST,
      near: (measure) => {
        if (!isPreset(measure)) return "other";
        return Number(measure.cost) <= COST_NEAR ? String(measure.bend) : undefined;
      },
      refuse: (measure) =>
        isPreset(measure) && Number(measure.cost) > COST && Number(measure.off) < TRUE && isBent(measure),
      solve: async (engine) => ({ path: "own", anchors: cheapest(await warpingOf(engine, PRESET.style)) }),
    },
    {
      id: "B",
      figure: "warp",
      start: { ...PRESET, path: "dtw" },
      pass: (measure) => isPreset(measure) && measure.agreeLinear === 0 && measure.agreeDtw === 1,
      near: (measure) => {
        if (!isPreset(measure)) return "other";
        if (Math.abs(missing(measure)) > FRAMES_NEAR) return undefined;
        return missing(measure) > 0 ? "later" : "earlier";
      },
      refuse: (measure) =>
        isPreset(measure) &&
        measure.agreeDtw === 0 &&
        measure.agreeLinear === 0 &&
        Math.abs(missing(measure)) > FRAMES_NEAR,
      solve: async (engine) => ({ at: mendedFrames(await warpingOf(engine, PRESET.style))[0]! }),
    },
  ],
});

/** Whether the own path is bent at all: the straight one is close to the exact path. */
function isBent({ cost, costLinear }: Measure): boolean {
  return Math.abs(Number(cost) - Number(costLinear)) > 0.01;
}

/** Anchors of a cheap path: each is moved while that lowers the cost, with decreasing steps. */
function cheapest(warping: Warping): readonly Anchor[] {
  let { anchors } = PRESET;
  let least = costRatio(warping, ownPath(warping, anchors));
  for (let step = 0.08; step > LEAST_STEP; ) {
    const before = least;
    for (const which of anchors.keys())
      for (const [x, y] of [
        [step, 0],
        [-step, 0],
        [0, step],
        [0, -step],
      ] as const) {
        const tried = moved(warping, anchors, which, { x: anchors[which]!.x + x, y: anchors[which]!.y + y });
        const cost = costRatio(warping, ownPath(warping, tried));
        if (cost < least) [least, anchors] = [cost, tried];
      }
    if (least === before) step /= 2;
  }
  return anchors;
}
