/** The engine's own package: importing this module makes the thread use it. */
import { assetOf } from "./assets";
import * as glue from "./pkg/strut_wasm.js";
import { servePackage } from "./wasm";

servePackage(glue, () => assetOf("strut_wasm_bg.wasm", () => new URL("./pkg/strut_wasm_bg.wasm", import.meta.url)));
