/** Shared by the figures of a page: the engine, and its memoised answers. */
import { createLearnClient } from "../client/learn/learn_client";
import type { LearnEngine } from "../client/learn/protocol";
import { Lingering } from "../ui/lingering";
import { memoized } from "./memoized";
import { pairOf } from "./pairing";

/** Time for which the engine is kept without figures, milliseconds. */
const LINGER_MS = 5000;

/** The engine of all figures. */
export const engines = new Lingering(LINGER_MS, createLearnClient, (engine) => engine.dispose());

/** Makes the engine open the data that figures need first, which takes long; it ends if no figure joins. */
export function startEngine(begin: (engine: LearnEngine) => Promise<unknown>): void {
  // A failure is reported by the figure that needs the data.
  const { value, release } = engines.lease();
  begin(value).catch(() => {});
  release();
}

/** {@link pairOf}, computed once. */
export const sharedPair = memoized(pairOf);
