/** The kind of renderer in this browser. */

/** None, because WebGL 2 is missing; the CPU; or a GPU. */
export type Graphics = "none" | "software" | "hardware";

/** Renderers without a GPU. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|basic render|software/i;

let known: Graphics | undefined;

/** Queried once from a temporary context: multisampling must be chosen before the drawing context is created. */
export function graphics(): Graphics {
  return known ?? askPage();
}

/** The same query on a context of the page itself, regardless of a worker's result. */
export function askPage(): Graphics {
  known = detectGraphics(Object.assign(document.createElement("canvas"), { width: 1, height: 1 }));
  return known;
}

/** Sets a worker's result, so that the page need not create a context for it. */
export function setGraphics(detected: Graphics): void {
  known = detected;
}

/** Creates a context on a canvas that is used for nothing else, queries its renderer, and releases the context. */
export function detectGraphics(canvas: HTMLCanvasElement | OffscreenCanvas): Graphics {
  const gl = canvas.getContext("webgl2", { antialias: false, depth: false }) as WebGL2RenderingContext | null;
  if (!gl) return "none";
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name) ? "software" : "hardware";
}
