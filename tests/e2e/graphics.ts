/** Software rendering of Chromium, without a GPU. */
import { existsSync } from "node:fs";

/** Flags and environment of Chromium. */
export interface Graphics {
  args: string[];
  env: Record<string, string>;
}

/** SwiftShader is part of Chromium and draws the same pictures on every machine. */
export const SWIFTSHADER: Graphics = {
  args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  env: {},
};

/** Mesa's llvmpipe without a display: its frame rate is about twice SwiftShader's. */
const MESA: Graphics = {
  args: ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"],
  env: { LIBGL_ALWAYS_SOFTWARE: "1", EGL_PLATFORM: "surfaceless" },
};

/** Mesa's EGL driver in Debian's package `libegl-mesa0`. */
const MESA_EGL = ["x86_64", "aarch64"].map((arch) => `/usr/lib/${arch}-linux-gnu/libEGL_mesa.so.0`);

/** Returns the faster one of the two that is installed. */
export function softwareGraphics(): Graphics {
  return MESA_EGL.some((path) => existsSync(path)) ? MESA : SWIFTSHADER;
}
