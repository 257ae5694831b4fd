import { detectGraphics } from "../../viewer/stage/graphics";

/** The renderer is running once the worker has answered. */
self.postMessage(detectGraphics(new OffscreenCanvas(1, 1)));
