import { expect, test } from "vitest";
import { overGround, stickWish } from "./wish";

test("a stick at rest asks for nothing, however it trembles", () => {
  expect([stickWish(0, 0, 1), stickWish(0.14, 0.14, 1), stickWish(Number.NaN, 0, 1)]).toEqual([
    undefined,
    undefined,
    undefined,
  ]);
});

test("a stick that is little deflected turns, and farther out it goes by the square of its way", () => {
  expect(stickWish(0.3, 0, 1)).toEqual({ right: 1, ahead: 0, gait: 1, turns: true });
  const half = stickWish(0, 0.6, 2)!;
  expect([half.right, half.ahead, half.turns, half.gait]).toEqual([0, expect.closeTo(0.25, 6), false, 2]);
  expect(stickWish(0, 1.3, 1)).toMatchObject({ ahead: 1 });
});

test("what is ahead in the picture is away from the camera, and right is right of that", () => {
  // Down a little, towards −Z: the character is seen from +Z, and +X is at the right.
  const sight = [0, -0.5, -0.8] as const;
  const ahead = overGround({ right: 0, ahead: 1, gait: 1 }, sight);
  const right = overGround({ right: 0.5, ahead: 0, gait: 1 }, sight);
  expect(ahead.map((v) => v + 0)).toEqual([0, -1]);
  expect(right.map((v) => v + 0)).toEqual([0.5, 0]);
});
