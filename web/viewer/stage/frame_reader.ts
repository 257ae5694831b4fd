/**
 * Copies drawn frames to the page without blocking it. Without a GPU some browsers copy a displayed WebGL canvas
 * themselves, and the page waits until its frame is drawn.
 */

import type { GpuQueue } from "./gpu_queue";

/** Reads the frames of one context. */
export class FrameReader {
  readonly #gl: WebGL2RenderingContext;
  readonly #queue: Pick<GpuQueue, "finished">;
  #pixels = new Uint8Array(0);
  #generation = 0;

  constructor(gl: WebGL2RenderingContext, queue: Pick<GpuQueue, "finished">) {
    this.#gl = gl;
    this.#queue = queue;
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
    // A new buffer for each frame: Chromium copies its pixels in advance. Reading a used buffer waits for the GPU.
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.bufferData(gl.PIXEL_PACK_BUFFER, bytes, gl.STREAM_READ);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, 0);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    await this.#queue.finished();
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
