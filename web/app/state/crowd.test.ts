import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { CROWD_KINDS, CROWD_RANGES, Refused } from "./crowd";
import { type AppState, fromHash, initialState, toHash } from "./state";

const state = (patch: Partial<AppState>): AppState => ({ ...initialState(), ...patch });
const vertex = { style: "proud", x: 2.5, z: -1, reach: 3, intensity: 1 };

describe("a crowd in a link", () => {
  it("is readable", () => {
    const field = [vertex, { style: "not_confident", x: 0, z: 0.25, reach: 0.5, intensity: -1 }];
    const link = toHash(
      state({
        view: "crowd",
        crowdKind: "performers",
        crowd: { count: 300, seed: 7 },
        field,
        route: [
          [-5, 0],
          [5, 2.5],
        ],
      }),
    );
    expect(decodeURIComponent(link)).toBe(
      "view=crowd&people=performers&crowd=300_7&field=proud_2.5_-1_3_1;not_confident_0_0.25_0.5_-1&route=-5_0;5_2.5",
    );
    expect(fromHash(link)).toMatchObject({ field, crowdKind: "performers", crowd: { count: 300, seed: 7 } });
  });

  it("comes back whatever it is", () => {
    const inRange = ({ min, max, digits }: { min: number; max: number; digits: number }) =>
      fc.double({ min, max, noNaN: true }).map((n) => Number(n.toFixed(digits)) + 0);
    const { count, seed, place, reach, intensity } = CROWD_RANGES;
    const style = fc.stringMatching(/^[^;]+$/);
    const point = fc.tuple(inRange(place), inRange(place));
    const patch = fc.record({
      crowdKind: fc.constantFrom(...CROWD_KINDS),
      crowd: fc.record({ count: inRange(count), seed: inRange(seed) }),
      field: fc.option(
        fc.array(
          fc.record({
            style,
            x: inRange(place),
            z: inRange(place),
            reach: inRange(reach),
            intensity: inRange(intensity),
          }),
          { maxLength: 12 },
        ),
        { nil: undefined },
      ),
      route: fc.oneof(fc.constant([]), fc.array(point, { minLength: 2, maxLength: 64 })),
      crowdWalker: fc.integer({ min: -1, max: 999 }),
      crowdCamera: fc.constantFrom("orbit" as const, "above" as const, "along" as const),
    });
    fc.assert(
      fc.property(patch, (p) => {
        expect(fromHash(`#${toHash(state(p))}`)).toEqual(state(p));
      }),
    );
  });

  it("that cannot be is refused, and kept as it stands there", () => {
    const entry = "proud_2.5_-1_3_1";
    const bad = [
      ["crowd", "0_1", "count"],
      ["crowd", "1001_1", "count"],
      ["crowd", "NaN", "count"],
      ["crowd", "20.5_1", "count"],
      ["crowd", "20_-1", "count"],
      ["crowd", "20_1_1", "count"],
      ["field", Array(13).fill(entry).join(";"), "vertices"],
      ["field", "proud_NaN_-1_3_1", "vertex"],
      ["field", "proud_Infinity_-1_3_1", "vertex"],
      ["field", "proud_2.5_-1_0.4_1", "vertex"],
      ["field", "proud_2.5_-1_3_2.1", "vertex"],
      ["field", "proud_101_-1_3_1", "vertex"],
      ["field", "2.5_-1_3_1", "vertex"],
      ["field", `${entry};`, "vertex"],
      ["route", "1_1", "route"],
      ["route", "1_1;2", "route"],
      ["route", "1_1;NaN_2", "route"],
      ["route", Array(65).fill("1_1").join(";"), "route"],
    ] as const;
    for (const [key, text, why] of bad) {
      const read = fromHash(`${key}=${text}`);
      expect(read[key], text).toEqual(new Refused(text, why));
      expect(decodeURIComponent(toHash(read))).toBe(`${key}=${text}`);
    }
  });

  it("tells no field from an empty one, takes a count alone, and keeps a kind that there is not", () => {
    expect(fromHash("field=none").field).toEqual([]);
    expect(toHash(state({ field: [] }))).toBe("field=none");
    expect(fromHash("field=").field).toBeUndefined();
    const kind = fromHash("people=dancers");
    expect([kind.crowdKind, toHash(kind)]).toEqual([new Refused("dancers", "kind"), "people=dancers"]);
    expect(fromHash("crowd=50").crowd).toEqual({ count: 50, seed: 1 });
  });
});
