import "./whole";
import { expect, test } from "vitest";
import { loadBuiltIn } from "./built_in";
import { Engine } from "./engine";
import { guarded } from "./wasm";

test("the size of the memory is that of the instance which took the place of a lost one", async () => {
  const engine = await Engine.load();
  engine.openDatabase({ kind: "demo", motions: await loadBuiltIn() });
  const { wasmBytes } = engine.memory();
  const fail = () => {
    throw new WebAssembly.RuntimeError("unreachable");
  };
  expect(() => guarded(fail)).toThrow("The engine ran out of memory.");
  expect((await Engine.load()).memory().wasmBytes).toBeLessThan(wasmBytes);
});
