/** Software rendering of Chromium, without a GPU. */
import { existsSync } from "node:fs";
import type { JSHandle, Page } from "playwright-core";

declare const window: { webglContexts: WeakRef<WebGL2RenderingContext>[] };

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

/** Records the WebGL contexts of a page's canvases, which need not be in the document. Call it before the page is loaded. */
export async function recordContexts(page: Page): Promise<void> {
  await page.addInitScript(() => {
    window.webglContexts = [];
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: unknown[]) {
      const context = (getContext as (...args: unknown[]) => unknown).apply(this, args);
      if (context instanceof WebGL2RenderingContext) window.webglContexts.push(new WeakRef(context));
      return context;
    } as typeof getContext;
  });
}

/** The WebGL context that a page created last and that is not lost. */
export async function lastContext(page: Page): Promise<JSHandle<WebGL2RenderingContext>> {
  return page.evaluateHandle(() => {
    const contexts = window.webglContexts.map((context) => context.deref());
    const live = contexts.filter((context) => context !== undefined && !context.isContextLost());
    if (live.length === 0) throw new Error("The page has no WebGL context.");
    return live.at(-1)!;
  });
}
