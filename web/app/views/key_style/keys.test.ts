import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { decodeTimed, encodeTimed, LENGTH_RANGE, MAX_KEYS, type TimedValue } from "../../state/key_style";
import { fitted, keyAt, MIN_GAP, moveKey, removeKey, setKey, withValues } from "./keys";

const KEYS: TimedValue[] = [
  { secs: 0, values: [20, 89] },
  { secs: 0.55, values: [6, 85.6] },
  { secs: 1.05, values: [24, 86.4] },
];
const LENGTH = 2.4;

const inOrder = (keys: readonly TimedValue[]) =>
  keys.every(({ secs }, i) => secs >= 0 && (i === 0 || secs - keys[i - 1]!.secs > MIN_GAP - 1e-9));

/** Actions of the user on keys. */
const act = fc.oneof(
  fc.record({ kind: fc.constant("set" as const), secs: fc.double({ min: 0, max: LENGTH, noNaN: true }) }),
  fc.record({ kind: fc.constant("move" as const), key: fc.nat(20), secs: fc.double({ min: -9, max: 9, noNaN: true }) }),
  fc.record({ kind: fc.constant("remove" as const), key: fc.nat(20) }),
);

describe("keys", () => {
  it("are set between the others, and where there is one it changes", () => {
    const { keys, key } = setKey(KEYS, 0.8, [1, 2]);
    expect(key).toBe(2);
    expect(keys.map((k) => k.secs)).toEqual([0, 0.55, 0.8, 1.05]);
    expect(setKey(keys, 0.801, [3, 4])).toMatchObject({ key: 2, keys: { length: 4 } });
    expect(setKey(keys, 0.801, [3, 4]).keys[2]).toEqual({ secs: 0.8, values: [3, 4] });
  });

  it("stay between their neighbours and in the animation when they are dragged", () => {
    expect(moveKey(KEYS, 1, 9, LENGTH)[1]!.secs).toBeCloseTo(1.05 - MIN_GAP);
    expect(moveKey(KEYS, 1, -9, LENGTH)[1]!.secs).toBeCloseTo(MIN_GAP);
    expect(moveKey(KEYS, 2, 9, LENGTH)[2]!.secs).toBe(LENGTH);
    expect(moveKey(KEYS, 0, -9, LENGTH)[0]!.secs).toBe(0);
    expect(withValues(KEYS, 1, [7, 8])[1]).toEqual({ secs: 0.55, values: [7, 8] });
  });

  it("keep their order and distance, whatever is done to them", () => {
    fc.assert(
      fc.property(fc.array(act, { maxLength: 120 }), (acts) => {
        let keys: TimedValue[] = [];
        for (const a of acts) {
          if (a.kind === "set") keys = setKey(keys, a.secs, [1]).keys;
          else if (keys.length === 0) continue;
          else if (a.kind === "move") keys = moveKey(keys, a.key % keys.length, a.secs, LENGTH);
          else keys = removeKey(keys, a.key % keys.length);
        }
        expect(inOrder(keys)).toBe(true);
        expect(keys.length).toBeLessThanOrEqual(MAX_KEYS);
        expect(keys.at(-1)?.secs ?? 0).toBeLessThanOrEqual(LENGTH);
      }),
    );
  });

  it("are as they were when a new one is taken away again", () => {
    fc.assert(
      fc.property(fc.double({ min: 0, max: LENGTH, noNaN: true }), (secs) => {
        const { keys, key } = setKey(KEYS, secs, [5, 5]);
        fc.pre(keys.length > KEYS.length);
        expect(removeKey(keys, key)).toEqual(KEYS);
        expect(keyAt(keys, secs)).toBe(key);
      }),
    );
  });

  it("come closer together where the animation becomes shorter", () => {
    expect(fitted(KEYS, 2.4)).toEqual(KEYS);
    expect(fitted(KEYS, 0.525).map((k) => k.secs)).toEqual([0, 0.275, 0.525]);
  });
});

describe("keys in links", () => {
  it("come back as they were", () => {
    const digits = (value: number) => Number(value.toFixed(2)) + 0;
    const value = fc.double({ min: -300, max: 300, noNaN: true }).map(digits);
    const timed = fc.integer({ min: 1, max: 3 }).chain((axes) =>
      fc
        .uniqueArray(
          fc.record({
            secs: fc.double({ min: 0, max: LENGTH_RANGE.max, noNaN: true }).map(digits),
            values: fc.array(value, { minLength: axes, maxLength: axes }),
          }),
          { selector: (key) => key.secs, maxLength: MAX_KEYS },
        )
        .map((keys) => keys.sort((a, b) => a.secs - b.secs)),
    );
    fc.assert(
      fc.property(timed, (keys) => {
        expect(decodeTimed(encodeTimed(keys), MAX_KEYS)).toEqual(keys);
      }),
    );
  });

  it("are passed over where they are none", () => {
    for (const text of ["x", "0_1;0_2", "1_1;0_2", "0_1;1_1_2", "0", "0_NaN", "0_", "-1_1", "0_1;", "99_1", "0_1e999"])
      expect(decodeTimed(text, MAX_KEYS), text).toBeUndefined();
    expect(decodeTimed("0_1;1_1", 1)).toBeUndefined();
  });

  it("are readable", () => {
    expect(encodeTimed(KEYS)).toBe("0_20_89;0.55_6_85.6;1.05_24_86.4");
  });
});
