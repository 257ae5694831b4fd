import { beforeAll, expect, test } from "vitest";
import { createLearnTable } from "../../client/learn/learn_table";
import { serveLearnPackage } from "../../engine/learn/wasm";
import { INPUTS, STYLES } from "./built_in";

beforeAll(serveLearnPackage);

test("the lists of styles and inputs are the engine's", async () => {
  const engine = createLearnTable();
  expect(await engine.styles()).toEqual([...STYLES]);
  expect(await engine.inputs()).toEqual([...INPUTS]);
});
