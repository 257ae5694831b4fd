/** Shared by the figures of a page: the engine, and its memoised answers. */
import { createLearnClient, type LearnClient } from "../client/learn/learn_client";
import type { LearnEngine } from "../client/learn/protocol";
import { pairOf } from "./pairing";
import { remembered } from "./remembered";

/** Time for which the engine is kept without figures, milliseconds. */
const LINGER_MS = 5000;

let client: LearnClient | undefined;
let users = 0;
let leaving: ReturnType<typeof setTimeout> | undefined;

/** The engine of all figures, until {@link leaveEngine}. */
export function joinEngine(): LearnEngine {
  users += 1;
  client ??= createLearnClient();
  return client;
}

/** Stops using the engine. */
export function leaveEngine(): void {
  users -= 1;
  clearTimeout(leaving);
  leaving = setTimeout(() => {
    if (users > 0) return;
    client?.dispose();
    client = undefined;
  }, LINGER_MS);
}

/** Makes the engine open the data that figures need first, which takes long; it ends if no figure joins. */
export function startEngine(begin: (engine: LearnEngine) => Promise<unknown>): void {
  // A failure is reported by the figure that needs the data.
  begin(joinEngine()).catch(() => {});
  leaveEngine();
}

/** {@link pairOf}, computed once. */
export const sharedPair = remembered(pairOf);
