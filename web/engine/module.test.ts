import { afterEach, expect, test, vi } from "vitest";
import { compileModule } from "./module";

const ENGINE = new URL("./pkg/strut_wasm_bg.wasm", import.meta.url);

afterEach(() => vi.restoreAllMocks());

test("a browser without SIMD is told so before anything is compiled", async () => {
  vi.spyOn(WebAssembly, "validate").mockReturnValue(false);
  const compile = vi.spyOn(WebAssembly, "compile");
  await expect(compileModule(ENGINE)).rejects.toMatchObject({
    code: "unsupported",
    message: expect.stringContaining("SIMD"),
    hint: expect.stringContaining("Safari"),
  });
  expect(compile).not.toHaveBeenCalled();
});

test("a browser with SIMD compiles the engine", async () => {
  expect(await compileModule(ENGINE)).toBeInstanceOf(WebAssembly.Module);
});
