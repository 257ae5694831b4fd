/** Measures for the exercises about the mixture of classes. */
import type { LearnEngine } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { lookOf, MIX_FIELDS, MIX_STYLE, type MixState } from "./mix_state";

/** A class at a frame. */
export interface ClassShare {
  action: string;
  style: string;
  /** λ, 0 to 1. */
  weight: number;
  /** D, cm². */
  square: number;
}

/** The weights of actions over an input. */
export interface Reading {
  actions: readonly string[];
  /** For each action its weight in every frame, 0 to 1. */
  weights: readonly Float32Array[];
  frames: number;
  rateHz: number;
}

/** The floor of the minimum distance, (1 mm)² in cm². */
export const FLOOR = 0.01;
/** The smallest distance at which input is half known, cm², and the factor by which δ is widened for unknown input. */
export const HALF_KNOWN = 25;
export const WIDEST = 3;

/** All classes at a state's frame, the nearest first. */
export async function sharesOf(engine: LearnEngine, state: MixState): Promise<ClassShare[]> {
  const [{ classes }, { weights, meanSquares }] = await Promise.all([engine.database(), engine.classes(lookOf(state))]);
  const shares = classes.map(({ action, style }, i) => ({
    action,
    style,
    weight: weights[i]!,
    square: meanSquares[i]! * 1e4,
  }));
  return shares.sort((a, b) => a.square - b.square);
}

/** δ as the engine widens it for input whose nearest class is at a distance, cm². */
export function widthAt(least: number, delta: number): number {
  const known = 1 / (1 + (least / HALF_KNOWN) ** 4);
  return delta * (WIDEST - (WIDEST - 1) * known);
}

/** λ of the first of some distances if they were the only ones, with a δ that is not widened (Eq. 4). */
export function weightAlone(squares: readonly number[], delta: number): number {
  const least = Math.max(FLOOR, Math.min(...squares));
  const raw = squares.map((square) => Math.exp(-(square - squares[0]!) / (delta * least)));
  return 1 / raw.reduce((sum, weight) => sum + weight, 0);
}

/** The engine's recognition of an input over time, with a given width; computed once. */
export const readingOf = memoized(async (engine, motion: string, delta: number): Promise<Reading> => {
  const options = { ...DEFAULT_OPTIONS, styles: { [MIX_STYLE]: 1 }, delta };
  const [{ classes, actions, rateHz }, { classWeights }] = await Promise.all([
    engine.database(),
    engine.stylize({ name: motion }, options),
  ]);
  const frames = classWeights.length / classes.length;
  const weights = actions.map(() => new Float32Array(frames));
  for (let frame = 0; frame < frames; frame++)
    classes.forEach(({ action }, i) => {
      weights[actions.indexOf(action)]![frame]! += classWeights[frame * classes.length + i]!;
    });
  return { actions, weights, frames, rateHz };
});

/** The first frame at which an action weighs as much as another; −1 if there is none. */
export function firstFrame({ actions, weights, frames }: Reading, rising: string, falling: string): number {
  const [up, down] = [rising, falling].map((action) => weights[actions.indexOf(action)]);
  if (!up || !down) return -1;
  for (let frame = 1; frame < frames; frame++) if (up[frame]! >= down[frame]!) return frame;
  return -1;
}

/** The measure of a state. */
export async function measureMix(engine: LearnEngine, state: MixState): Promise<Measure> {
  const [shares, reading] = await Promise.all([
    sharesOf(engine, state),
    readingOf(engine, state.motion, MIX_FIELDS.delta.initial),
  ]);
  const of = (action: string) => shares.reduce((sum, one) => sum + (one.action === action ? one.weight : 0), 0);
  const running = shares.find(({ action, style }) => action === "run" && style === "neutral");
  const [first, second] = shares;
  return {
    motion: state.motion,
    at: state.at,
    secs: Math.min(state.at, reading.frames - 1) / reading.rateHz,
    delta: state.delta,
    guess: state.guess,
    walk: of("walk"),
    run: of("run"),
    change: firstFrame(reading, "walk", "run"),
    running: running?.weight ?? 0,
    first: first!.square,
    second: second!.square,
    alone: weightAlone([first!.square, second!.square], state.delta),
    // Without the division by the minimum distance.
    plain: weightAlone([first!.square, second!.square], 1 / Math.max(FLOOR, first!.square)),
    heaviest: `${first!.action}/${first!.style}`,
  };
}
