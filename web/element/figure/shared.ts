/** What the figures of a page share: the engine, and what it was asked already. */
import { createLearnClient, type LearnClient } from "../../client/learn/learn_client";
import type { LearnEngine } from "../../client/learn/protocol";
import { pairOf } from "./pairing";
import { remembered } from "./remembered";

/** How long the engine is kept when no figure is left, milliseconds. */
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

/** Asks the engine no longer. */
export function leaveEngine(): void {
  users -= 1;
  clearTimeout(leaving);
  leaving = setTimeout(() => {
    if (users > 0) return;
    client?.dispose();
    client = undefined;
  }, LINGER_MS);
}

/** Has the engine open what figures begin with, which takes long; it ends if nobody joins. */
export function startEngine(begin: (engine: LearnEngine) => Promise<unknown>): void {
  // What fails is said by the figure that needs it.
  begin(joinEngine()).catch(() => {});
  leaveEngine();
}

/** {@link pairOf}, computed once. */
export const sharedPair = remembered(pairOf);
