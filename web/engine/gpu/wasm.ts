/** The WASM package for the GPU, loaded in a worker of its own, and only if there is a GPU. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_wasm_gpu.js";

export const gpuPackage = new SidePackage(glue, () =>
  assetOf("strut_wasm_gpu_bg.wasm", () => new URL("./pkg/strut_wasm_gpu_bg.wasm", import.meta.url)),
);
