import { beforeAll, expect, test } from "vitest";
import { createLearnTable } from "../client/learn/learn_table";
import { serveLearnPackage } from "../engine/learn/wasm";
import { POSE_FLOATS } from "../humanoid";
import { FRAMES, INPUTS, RATE_HZ, STYLES } from "./built_in";

beforeAll(serveLearnPackage);

test("lists of styles and inputs, and lengths, are the engine's", async () => {
  const engine = createLearnTable();
  expect(await engine.styles()).toEqual([...STYLES]);
  expect(await engine.inputs()).toEqual([...INPUTS]);
  const { poses, rateHz } = await engine.motion({ name: INPUTS[0] });
  expect([poses.length / POSE_FLOATS, rateHz]).toEqual([FRAMES, RATE_HZ]);
});
