/** Lesson: explain foot skate and its correction. */
import { fastestSlide, legOf, tracksOf } from "../figures/feet/feet_measure";
import { FEET_FIELDS, type FeetState, REACH, stretchOf } from "../figures/feet/feet_state";
import type { Measure } from "../figures/kind";
import { initialOf } from "../link/hash";
import equation from "./equations/feet.tex";
import { type Lesson, lesson } from "./lesson";

const PRESET = initialOf(FEET_FIELDS);

/** Exercise A: frames from the fastest slide that pass, and that are close. */
const FRAMES = 3;
const FRAMES_NEAR = 6;
/** Exercise B: the requested bend, degrees, and the tolerances of a pass and of a near miss. */
const BEND = 60;
const OFF = 1;
const NEAR = 4;
/** The bet: the first and the last part of a stance. */
const PART = 0.25;

const isFoot = ({ motion, style, foot, stretch }: Measure) =>
  motion === PRESET.motion && style === PRESET.style && foot === PRESET.foot && stretch === stretchOf(PRESET.at);
/** Whether a measure has the foot, the range and the setting of exercise A. */
const isPreset = (measure: Measure) => isFoot(measure) && measure.hold === 0;
/** Frames to the fastest slide. */
const missing = ({ fastest, at }: Measure) => Number(fastest) - Number(at);

export const feet: Lesson = lesson<FeetState>({
  id: "feet",
  fields: FEET_FIELDS,
  figures: [
    {
      name: "soles",
      kind: "soles",
      beats: ["idea", "bet", "look", "sources"],
      explained: ["idea", "look", "sources"],
    },
    { name: "feet", kind: "feet", beats: ["look", "exercises"] },
    { name: "leg", kind: "leg", beats: ["look", "why", "exercises", "sources"] },
  ],
  decimals: { speed: 0, most: 0, middle: 1, held: 1, d: 3, gamma: 1, bend: 1 },
  equation,
  symbols: ["P", "c", "p", "q", "gamma", "d", "i"],
  bet: {
    options: ["strike", "middle", "lift"],
    reveal: async (engine) => {
      const tracks = await tracksOf(engine, PRESET);
      const fastest = fastestSlide(tracks, stretchOf(PRESET.at));
      let [from, to] = [fastest, fastest];
      while (tracks.stands[from - 1] === 1) from--;
      while (tracks.stands[to + 1] === 1) to++;
      const share = (fastest - from) / (to - from);
      const answer = share < PART ? "strike" : share > 1 - PART ? "lift" : "middle";
      const middle = (from + to) >> 1;
      const speeds = { most: tracks.free.speeds[fastest]!, middle: tracks.free.speeds[middle]! };
      const place = { nth: String(fastest - from + 1), frames: String(to - from + 1) };
      return { answer, measure: { ...speeds, ...place, held: tracks.held.speeds[fastest]! } };
    },
  },
  exercises: [
    {
      id: "A",
      figure: "feet",
      start: { ...PRESET },
      pass: (measure) => isPreset(measure) && measure.stands === 1 && Math.abs(missing(measure)) <= FRAMES,
      near: (measure) => {
        if (!isFoot(measure)) return "other";
        if (measure.hold !== 0) return "held";
        if (Math.abs(missing(measure)) > FRAMES_NEAR) return undefined;
        return missing(measure) > 0 ? "later" : "earlier";
      },
      // Just before the strike the foot is also lifted: that is a near miss.
      refuse: (measure) => isPreset(measure) && measure.stands === 0 && Math.abs(missing(measure)) > FRAMES_NEAR,
      solve: async (engine) => ({
        at: fastestSlide(await tracksOf(engine, PRESET), stretchOf(PRESET.at)),
        hold: false,
      }),
    },
    {
      id: "B",
      figure: "leg",
      start: { ...PRESET },
      pass: ({ bend }) => Math.abs(Number(bend) - BEND) <= OFF,
      near: ({ bend }) => {
        if (Math.abs(Number(bend) - BEND) > NEAR) return undefined;
        return Number(bend) < BEND ? "more" : "less";
      },
      refuse: ({ gamma }) => Math.abs(Number(gamma) - BEND) <= NEAR,
      solve: async (engine) => {
        const [a, b] = await legOf(engine, PRESET.motion);
        const d = Math.sqrt(a * a + b * b + 2 * a * b * Math.cos((BEND * Math.PI) / 180));
        return { x: 0, y: -Number(d.toFixed(REACH.y.digits)) };
      },
    },
  ],
});
