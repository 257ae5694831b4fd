import { expect, test } from "vitest";
import { styleName } from "./style_of_clip";

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
