import { expect, test } from "vitest";
import { actionIn, secondsOf, styleName } from "./style_of_clip";

test("a style is named by what its file's name says beside action and number", () => {
  const name = (file: string, styles: string[] = []) => styleName(file, ["walk", "run"], styles);
  expect(name("dataset-2_walk_elderly_001.bvh")).toBe("elderly");
  expect(name("angry_01_000.bvh")).toBe("angry");
  expect(name("Walking Very Tired 3.BVH")).toBe("Very Tired");
  expect(name("walk.bvh")).toBe("walk");
  expect(name("歩き_元気.bvh")).toBe("歩き 元気");
  expect(name(".bvh")).toBe("new style");
  expect(name("angry_2.bvh", ["angry", "angry 2"])).toBe("angry 3");
});

test("the action of a clip is the one that its file is named by", () => {
  const action = (file: string) => actionIn(file, ["walk", "run", "punch"]);
  expect(["Walk_old_01.bvh", "punch.BVH", "weary.bvh", "walk to run.bvh"].map(action)).toEqual([
    "walk",
    "punch",
    undefined,
    undefined,
  ]);
});

test("how long a clip lasts is read from its head", async () => {
  const file = (text: string) => new Blob([`HIERARCHY\nROOT Hips\n${text}\n0 0 0\n`]);
  expect(await secondsOf(file("MOTION\nFrames: 90\nFrame Time: 0.0166667"))).toBeCloseTo(1.5, 3);
  expect(await secondsOf(file("MOTION\r\nFrames:\t2\r\nFrame Time: 1e-2"))).toBeCloseTo(0.02, 6);
  expect(await secondsOf(file("no motion"))).toBeUndefined();
});
