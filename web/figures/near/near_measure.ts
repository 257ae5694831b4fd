/** Measures for the exercises about the distance of two windows. */
import type { LearnEngine, Profile } from "../../client/learn/protocol";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { changeOf, lengthOf, lookOf, NEAR_FIELDS, type NearState, NO_GUESS, WINDOWS } from "./near_state";

/** A query, and the windows of a class from the nearest to the farthest. */
export interface Found extends Profile {
  /** Indices into the profile, nearest first; nonexistent windows are left out. */
  order: Uint32Array;
}

/** Profiles of queries, computed once. */
const profileOf = memoized(async (engine, query: NearState): Promise<Found> => {
  const profile = await engine.profile(lookOf(query), { length: lengthOf(query), query: changeOf(query) });
  const { distances } = profile;
  const order = Uint32Array.from(distances.keys())
    .filter((at) => Number.isFinite(distances[at]))
    .sort((a, b) => distances[a]! - distances[b]!);
  return { ...profile, order };
});

/** The windows with which a state's query is compared. */
export function foundOf(engine: LearnEngine, state: NearState): Promise<Found> {
  // The use of the windows is not part of the request.
  return profileOf(engine, { ...state, k: NEAR_FIELDS.k.initial, guess: NO_GUESS });
}

/** √D of the nearest window at a given rank, metres. */
export function distanceOf({ order, distances }: Found, place: number): number {
  return distances[order[place] ?? -1] ?? Number.NaN;
}

/** Ratio of the nearest window's distance with reversed time to that without. */
export async function backwards(engine: LearnEngine, state: NearState): Promise<number> {
  const [forward, reversed] = await Promise.all(
    [false, true].map((reversed) => foundOf(engine, { ...state, reversed })),
  );
  return distanceOf(reversed!, 0) / distanceOf(forward!, 0);
}

/** Millimetres per metre. */
const MM = 1000;

/** The measure of a state; distances in millimetres, whole numbers as text. */
export async function measureNear(engine: LearnEngine, state: NearState): Promise<Measure> {
  const [found, unmoved, ...ratios] = await Promise.all([
    foundOf(engine, state),
    foundOf(engine, { ...state, heading: 0, x: 0, z: 0 }),
    ...WINDOWS.map((window) => backwards(engine, { ...state, window })),
  ]);
  const first = MM * distanceOf(found, 0);
  const last = MM * distanceOf(found, state.k - 1);
  const next = MM * distanceOf(found, state.k);
  return {
    motion: state.motion,
    at: state.at,
    turned: state.turned.length,
    heading: String(Math.abs(state.heading)),
    moved: Math.hypot(state.x, state.z),
    window: state.window,
    reversed: state.reversed ? 1 : 0,
    K: String(state.k),
    first,
    last,
    next,
    lastRatio: last / first,
    nextRatio: next / first,
    guess: state.guess === NO_GUESS ? Number.NaN : state.guess,
    change: Math.abs(first - MM * distanceOf(unmoved, 0)),
    ...Object.fromEntries(WINDOWS.map((window, i) => [`backwards${window}`, ratios[i]!])),
  };
}
