import { detectGraphics } from "../../viewer/stage/graphics";

/** What draws for the browser is running once it has answered. */
self.postMessage(detectGraphics(new OffscreenCanvas(1, 1)));
