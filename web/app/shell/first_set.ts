/** Chooses the built-in motions that a page opens first. It is part of the first script, which makes the engine load them. */
import type { BuiltInSet } from "../../client/protocol";

/** Whether a page is opened without a state in its link. The pose of such a state would differ with a few strides alone. */
export function isPlain(hash: string): boolean {
  return hash.length <= 1;
}

/** The set that the engine starts to load. */
export function firstSet(hash: string): BuiltInSet {
  return isPlain(hash) ? "first" : "built-in";
}
