import { expect, test } from "vitest";
import { CROWD_WALKER_FLOATS } from "../../../humanoid";
import { asWalkBlock, Strides, sharesOf } from "./walker_facts";

const STYLES = ["angry", "old", "proud"];
const vertex = (style: string) => ({ style, x: 0, z: 0, reach: 1, intensity: 1 });

test("shares are those of the field's styles in its order, and the rest is the average", () => {
  const weights = Uint8Array.of(0, 0, 0, 0, 51, 102);
  const shares = sharesOf({ weights }, 1, STYLES, [vertex("proud"), vertex("old"), vertex("proud")], "average");
  expect(shares.map(({ name, share }) => [name, Number(share.toFixed(2))])).toEqual([
    ["proud", 0.4],
    ["old", 0.2],
    ["average", 0.4],
  ]);
});

test("a plan for the Walk view has the same mixture", () => {
  expect(asWalkBlock({ weights: Uint8Array.of(0, 51, 102) }, 0, STYLES)).toEqual({
    styles: [
      { name: "old", weight: expect.closeTo(1 / 3) },
      { name: "proud", weight: expect.closeTo(2 / 3) },
    ],
    intensity: 0.6,
    steps: 8,
    transition: 0,
  });
  expect(asWalkBlock({ weights: Uint8Array.of(0, 0, 0) }, 0, STYLES)).toMatchObject({ intensity: 0 });
});

test("speed is that of the last half second of one walker", () => {
  const strides = new Strides();
  const at = (x: number) => ({ joints: new Float32Array(2 * CROWD_WALKER_FLOATS).fill(x) });
  for (let i = 0; i < 60; i++) strides.add(at(i < 30 ? 0 : 0.04 * (i - 30)), 1);
  expect(strides.speed(1, 30)).toBeCloseTo(1.2 * Math.SQRT2, 3);
  expect(strides.speed(0, 30)).toBe(0);
  strides.add(at(5), 0);
  expect(strides.speed(0, 30)).toBe(0);
});
