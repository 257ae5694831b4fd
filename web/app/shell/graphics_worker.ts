/** Draws nothing, once: what draws for the browser is running then. */
const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
gl?.getExtension("WEBGL_lose_context")?.loseContext();
self.postMessage("started");
