/** The WASM package of driving, loaded when steering begins. */
import { assetOf } from "../assets";
import { SidePackage } from "../side_package";
import * as glue from "./pkg/strut_drive.js";

/** The generated bindings. */
export type DriveGlue = typeof glue;

export const drivePackage = new SidePackage(glue, () =>
  assetOf("strut_drive_bg.wasm", () => new URL("./pkg/strut_drive_bg.wasm", import.meta.url)),
);
