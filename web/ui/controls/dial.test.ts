import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { type DialRange, parseTyped, shareOf, stepped, valueAt } from "./dial";

const K: DialRange = { min: 5, max: 160, digits: 0, scale: "log" };
const RHO: DialRange = { min: 0, max: 1, digits: 2, scale: "linear" };

describe("a dial", () => {
  it("stands where its value is, by ratio on a logarithmic one", () => {
    expect(shareOf(0.5, RHO)).toBeCloseTo(0.5);
    expect(shareOf(Math.sqrt(5 * 160), K)).toBeCloseTo(0.5);
    expect([valueAt(-1, K), valueAt(2, K)]).toEqual([5, 160]);
  });

  it("comes back to every value it can show", () => {
    fc.assert(
      fc.property(fc.integer({ min: 5, max: 160 }), (k) => {
        expect(valueAt(shareOf(k, K), K)).toBe(k);
      }),
    );
  });

  it("moves with every step, and stops at the ends", () => {
    fc.assert(
      fc.property(fc.integer({ min: 5, max: 160 }), (k) => {
        expect(stepped(k, 0.001, K)).toBe(Math.min(160, k + 1));
        expect(stepped(k, -0.001, K)).toBe(Math.max(5, k - 1));
      }),
    );
    expect(stepped(1, 0.05, RHO)).toBe(1);
    expect(stepped(0.5, 0.05, RHO)).toBe(0.55);
  });

  it("takes typed numbers and nothing else", () => {
    expect(parseTyped(" 0,25 ", RHO)).toBe(0.25);
    expect(parseTyped("7", RHO)).toBe(1);
    expect(parseTyped("", RHO)).toBeUndefined();
    expect(parseTyped("much", RHO)).toBeUndefined();
  });
});
