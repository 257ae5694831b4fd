/** Measures for the exercises about feet. */
import type { LearnEngine } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { JOINT } from "../../humanoid";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { type FeetState, inputOf, lookOf, STRETCH, stretchOf } from "./feet_state";
import { pivotTravel, SIDES, type Side, type Sole, solesOf } from "./soles";

/** A foot of a styled motion. */
export interface Track {
  soles: readonly Sole[];
  /** Ground speed of the foot's pivot, cm/s. */
  speeds: Float64Array;
}

/** A foot with and without the hold. */
export interface Tracks {
  rateHz: number;
  held: Track;
  free: Track;
  /** Whether it is planted in each frame, 1 or 0. */
  stands: Uint8Array;
}

const CM = 100;

/** A foot is planted from the first likelihood on, and until it is below the second: the engine's `contact_likelihood.rs`. */
export const PLANT = 0.6;
export const RELEASE = 0.4;

const tracked = memoized(async (engine, motion: FeetState["motion"], style: string, side: Side): Promise<Tracks> => {
  const input = inputOf({ motion });
  const run = (footplant: boolean) => engine.stylize(input, { ...DEFAULT_OPTIONS, styles: { [style]: 1 }, footplant });
  const [{ proportions, rateHz }, held, free] = await Promise.all([engine.motion(input), run(true), run(false)]);
  const trackOf = ({ poses, timeOut }: typeof held): Track => {
    const soles = solesOf(poses, proportions, side);
    const speeds = Float64Array.from(soles, (sole, frame) => {
      if (frame === 0) return 0;
      return (CM * Math.hypot(...pivotTravel(sole, soles[frame - 1]!))) / (timeOut[frame]! - timeOut[frame - 1]!);
    });
    return { soles, speeds };
  };
  const foot = SIDES.indexOf(side);
  const stands = Uint8Array.from({ length: held.planted.length / 2 }, (_, frame) => held.planted[2 * frame + foot]!);
  return { rateHz, held: trackOf(held), free: trackOf(free), stands };
});

/** A state's foot with and without the hold; computed once. */
export function tracksOf(engine: LearnEngine, { motion, style, foot }: FeetState): Promise<Tracks> {
  return tracked(engine, motion, style, foot);
}

/** Frames between two requested votes. */
const VOTE_STEP = 3;

/** P of a foot over a range. */
export interface Votes {
  /** Frames of the input. */
  frames: readonly number[];
  /** The share of the neighbours' votes, and the likelihood that decides planting: with the targets' contacts, smoothed. */
  votes: readonly number[];
  likelihoods: readonly number[];
}

const voted = memoized(
  async (engine, motion: FeetState["motion"], style: FeetState["style"], side: Side, first: number, last: number) => {
    const frames = Array.from({ length: Math.floor((last - first) / VOTE_STEP) + 1 }, (_, i) => first + i * VOTE_STEP);
    const foot = SIDES.indexOf(side);
    const contacts = await Promise.all(frames.map((frame) => engine.contacts(lookOf({ motion, style }, frame))));
    return {
      frames,
      votes: contacts.map(({ votes }) => votes[foot]!),
      likelihoods: contacts.map(({ output }) => output[foot]!),
    };
  },
);

/** A state whose frame is within a motion. */
export function within(state: FeetState, { stands }: Tracks): FeetState {
  return { ...state, at: Math.min(state.at, stands.length - 1) };
}

/** The votes on a state's foot in the range around its frame, of `frames` frames in all; computed once. */
export function votesOf(engine: LearnEngine, { at, ...state }: FeetState, frames: number): Promise<Votes> {
  const begin = stretchOf(Math.min(at, frames - 1));
  const [first, last] = [Math.max(2, begin), Math.min(frames, begin + STRETCH) - 1];
  return voted(engine, state.motion, state.style, state.foot, first, last);
}

/** The frame of a range in which a planted foot that is not held slides fastest; −1 if none is planted. */
export function fastestSlide({ free, stands }: Tracks, first: number): number {
  let fastest = -1;
  for (let frame = Math.max(1, first); frame < Math.min(stands.length, first + STRETCH); frame++) {
    const isFaster = fastest < 0 || free.speeds[frame]! > free.speeds[fastest]!;
    if (stands[frame] === 1 && isFaster) fastest = frame;
  }
  return fastest;
}

/** Lengths of thigh and shin, metres. */
export const legOf = memoized(async (engine, motion: FeetState["motion"]): Promise<readonly [a: number, b: number]> => {
  const { proportions } = await engine.motion(inputOf({ motion }));
  const length = (joint: number) => Math.hypot(...[0, 1, 2].map((axis) => proportions[3 * joint + axis]!));
  return [length(JOINT.left_lower_leg), length(JOINT.left_foot)];
});

/** A leg that reaches a position of its ankle. */
export interface Leg {
  a: number;
  b: number;
  /** Distance from hip to ankle, limited by the leg's length, metres. */
  d: number;
  /** Angle between thigh and shin, degrees, and the bend of the knee. */
  gamma: number;
  bend: number;
}

/** The law of cosines. */
export function solveLeg([a, b]: readonly [a: number, b: number], x: number, y: number): Leg {
  const d = Math.min(a + b, Math.max(Math.abs(a - b), Math.hypot(x, y)));
  const cosine = Math.min(1, Math.max(-1, (a * a + b * b - d * d) / (2 * a * b)));
  const gamma = (Math.acos(cosine) * 180) / Math.PI;
  return { a, b, d, gamma, bend: 180 - gamma };
}

/** The measure of a state; speeds in cm/s. */
export async function measureFeet(engine: LearnEngine, state: FeetState): Promise<Measure> {
  const [tracks, lengths] = await Promise.all([tracksOf(engine, state), legOf(engine, state.motion)]);
  const at = Math.min(state.at, tracks.stands.length - 1);
  const fastest = fastestSlide(tracks, stretchOf(at));
  const leg = solveLeg(lengths, state.x, state.y);
  return {
    motion: state.motion,
    style: state.style,
    foot: state.foot,
    hold: state.hold ? 1 : 0,
    at,
    stretch: stretchOf(at),
    stands: tracks.stands[at]!,
    fastest,
    speed: tracks.free.speeds[at]!,
    held: tracks.held.speeds[at]!,
    most: tracks.free.speeds[fastest] ?? Number.NaN,
    d: leg.d,
    gamma: leg.gamma,
    bend: leg.bend,
  };
}
