import { describe, expect, it } from "vitest";
import { ROLES } from "../../humanoid";
import { SLOTS, slotIndex } from "../../mannequin/slots";
import { slotsOf } from "./part_tint";

/** The slots of a mask, by name. */
const named = ([low, high]: [number, number]) =>
  SLOTS.filter((_, slot) => ((slot < 31 ? low >> slot : high >> (slot - 31)) & 1) === 1);

describe("the mask of tinted slots", () => {
  it("holds what follows the joints of a part, on its side only", () => {
    expect(named(slotsOf(["neck", "head"]))).toEqual(["neck", "head"]);
    const arm = named(slotsOf(["right_shoulder", "right_upper_arm", "right_lower_arm", "right_hand"]));
    expect(arm).toContain("right_hand");
    expect(arm.every((slot) => slot.startsWith("right_"))).toBe(true);
  });

  it("takes the waist for the spine, and everything for all joints", () => {
    expect(named(slotsOf(["spine"]))).toContain("waist_12");
    expect(named(slotsOf(ROLES))).toHaveLength(SLOTS.length);
    expect(slotsOf([])).toEqual([0, 0]);
    expect(slotIndex("waist_12")).toBeLessThan(62);
  });
});
