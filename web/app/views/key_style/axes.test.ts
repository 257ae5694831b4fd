import { expect, it } from "vitest";
import { decodeAxes, encodeAxes } from "../../state/key_style";
import { titleOf, usualAxes } from "./axes";

it("travels in links", () => {
  const axes = ["hips_height", "hand_l.y - shoulder_l.y"];
  expect(decodeAxes(encodeAxes(axes))).toEqual(axes);
  expect(decodeAxes("")).toEqual([]);
  for (const text of ["a~a", "a~b~c~d", "a~", "x".repeat(81)]) expect(decodeAxes(text), text).toBeUndefined();
});

it("has words for measures, and leaves expressions as they are", () => {
  expect(titleOf("reach_left")).toBe("left reach");
  expect(titleOf("hips.y * 2")).toBe("hips.y * 2");
});

it("fits the action", () => {
  expect(usualAxes("walk")[0]).toBe("foot_separation");
  expect(usualAxes("punch")).toEqual(["reach_left", "hips_height"]);
});
