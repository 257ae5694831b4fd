/** What draws for this browser. */

/** Nothing, as WebGL 2 is missing; the processor itself; or a graphics processor. */
export type Graphics = "none" | "software" | "hardware";

/** Renderers that have no graphics processor behind them. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|basic render|software/i;

let known: Graphics | undefined;

/** Queried once from a temporary context: multisampling must be chosen before the drawing context is made. */
export function graphics(): Graphics {
  return known ?? askPage();
}

/** The same, of a context of the page's own, whatever a worker detected. */
export function askPage(): Graphics {
  known = detectGraphics(Object.assign(document.createElement("canvas"), { width: 1, height: 1 }));
  return known;
}

/** Takes what a worker detected, so that the page need not make a context for it. */
export function setGraphics(detected: Graphics): void {
  known = detected;
}

/** Makes a context on a canvas that nothing else is drawn on, asks what draws there, and gives the context back. */
export function detectGraphics(canvas: HTMLCanvasElement | OffscreenCanvas): Graphics {
  const gl = canvas.getContext("webgl2", { antialias: false, depth: false }) as WebGL2RenderingContext | null;
  if (!gl) return "none";
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name) ? "software" : "hardware";
}
