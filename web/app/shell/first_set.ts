/** Which built-in motions a page opens first. It is part of the first script, which has the engine load them. */
import type { BuiltInSet } from "../../client/protocol";

/** Whether a page is opened without a link to a state, whose pose would be another with a few strides alone. */
export function isPlain(hash: string): boolean {
  return hash.length <= 1;
}

/** The set that the engine begins to load. */
export function firstSet(hash: string): BuiltInSet {
  return isPlain(hash) ? "first" : "built-in";
}
