/** Completion of the Key-style view's state from a model. */
import { describe, expect, it } from "vitest";
import { completed, hasHandle } from "./completion";

const FIRST = [
  { secs: 0, values: [1, 2] },
  { secs: 1.5, values: [3, 4] },
];
const MODEL = { middle: [5, 6], firstKeys: () => FIRST };
const EMPTY = { keys: [], keyChosen: -1, keyTrail: [], keyLength: 0, keyHandle: [] };

describe("completing the state", () => {
  it("takes keys, length and handle from the model where the state says nothing", () => {
    expect(completed(EMPTY, MODEL)).toEqual({ ...EMPTY, keys: FIRST, keyLength: 1.5, keyHandle: [5, 6] });
  });

  it("leaves a state that says everything as it is", () => {
    const state = { keys: FIRST, keyChosen: 1, keyTrail: FIRST, keyLength: 3, keyHandle: [7, 8] };
    expect(completed(state, MODEL)).toEqual(state);
    expect(hasHandle(state, MODEL)).toBe(true);
  });

  it("drops what belongs to another number of variables", () => {
    const other = [{ secs: 0, values: [1] }];
    const state = { keys: other, keyChosen: 0, keyTrail: other, keyLength: 2, keyHandle: [1] };
    expect(completed(state, MODEL)).toEqual({
      keys: FIRST,
      keyChosen: -1,
      keyTrail: [],
      keyLength: 2,
      keyHandle: [5, 6],
    });
  });

  it("puts a stale handle in the middle, and gives no keys to who has none", () => {
    const state = { ...EMPTY, keyHandle: [7, 8] };
    expect(completed(state, MODEL)).toMatchObject({ keys: [], keyLength: 0.5, keyHandle: [7, 8] });
    expect(completed(state, MODEL, true)).toMatchObject({ keys: [], keyHandle: [5, 6] });
  });
});
