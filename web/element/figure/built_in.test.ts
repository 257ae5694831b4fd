import { beforeAll, expect, test } from "vitest";
import { createLearnTable } from "../../client/learn/learn_table";
import { serveComparePackage } from "../../engine/compare/wasm";
import { INPUTS, STYLES } from "./built_in";

beforeAll(serveComparePackage);

test("the lists of styles and inputs are the engine's", async () => {
  const engine = createLearnTable();
  expect(await engine.styles()).toEqual([...STYLES]);
  expect(await engine.inputs()).toEqual([...INPUTS]);
});
