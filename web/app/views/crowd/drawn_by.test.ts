import { expect, test } from "vitest";
import { rendererName } from "./drawn_by";

test.each([
  ["ANGLE (Apple, ANGLE Metal Renderer: Apple M1, Unspecified Version)", "Apple M1"],
  ["ANGLE (NVIDIA, NVIDIA GeForce RTX 3060 (0x00002504) Direct3D11 vs_5_0 ps_5_0, D3D11)", "NVIDIA GeForce RTX 3060"],
  ["ANGLE (NVIDIA, Vulkan 1.3.277 (NVIDIA H100 80GB HBM3 (0x00002330)), NVIDIA)", "NVIDIA H100 80GB HBM3"],
  ["ANGLE (NVIDIA, Vulkan 1.4.312 (NVIDIA NVIDIA H200 (0x00002335)), NVIDIA)", "NVIDIA H200"],
  ["ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (LLVM 10.0.0) (0x0000C0DE)), SwiftShader driver)", "SwiftShader"],
  ["Mesa Intel(R) UHD Graphics 630 (CFL GT2)", "Mesa Intel(R) UHD Graphics 630 (CFL GT2)"],
  ["NVIDIA GeForce GTX 980/PCIe/SSE2", "NVIDIA GeForce GTX 980"],
  ["", ""],
])("%s", (drawnBy, name) => {
  expect(rendererName(drawnBy)).toBe(name);
});
