/**
 * Reads drawn frames back while the page goes on. Without a GPU some browsers read a WebGL canvas that is displayed
 * back themselves, and block the page until its frame is drawn.
 */

/** Interval at which the fence of a frame is polled, milliseconds. */
const POLL_MS = 4;

/** Reads the frames of one context. */
export class FrameReader {
  readonly #gl: WebGL2RenderingContext;
  #pixels = new Uint8Array(0);
  #generation = 0;

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
  }

  /**
   * Reads the lower left part of the frame that was drawn in this task. Frames arrive in the order of the calls.
   * @param show gets the pixels, RGBA with 8 bits each, in rows from the bottom up; valid during the call only. It is
   *   not called if the context is lost before the frame is drawn.
   */
  async read({ width, height }: { width: number; height: number }, show: (pixels: Uint8Array) => void): Promise<void> {
    const gl = this.#gl;
    const generation = this.#generation;
    const bytes = 4 * width * height;
    // Chromium copies the pixels of a new buffer in advance, so that they are read without waiting; not those of a used one.
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.bufferData(gl.PIXEL_PACK_BUFFER, bytes, gl.STREAM_READ);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, 0);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    do await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    while (fence && !gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED);
    gl.deleteSync(fence);
    if (generation !== this.#generation || gl.isContextLost()) return;
    if (this.#pixels.length !== bytes) this.#pixels = new Uint8Array(bytes);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.getBufferSubData(gl.PIXEL_PACK_BUFFER, 0, this.#pixels);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    gl.deleteBuffer(buffer);
    show(this.#pixels);
  }

  /** Discards the frames of a lost context, or of one that is released. */
  forget(): void {
    this.#generation++;
  }
}
