import { describe, expect, it } from "vitest";
import { FrameReader } from "./frame_reader";
import { GpuQueue } from "./gpu_queue";

/** A context that draws a frame when told to. Its pixels are the number of the frame. */
class FakeContext {
  readonly PIXEL_PACK_BUFFER = 1;
  readonly RGBA = 2;
  readonly UNSIGNED_BYTE = 3;
  readonly STREAM_READ = 4;
  readonly SYNC_GPU_COMMANDS_COMPLETE = 5;
  readonly SYNC_STATUS = 6;
  readonly SIGNALED = 7;
  /** Number of frames that are drawn. */
  drawn = 0;
  isLost = false;
  buffers = 0;
  #read = 0;
  #bound: { frame: number } | null = null;

  createBuffer() {
    this.buffers++;
    return { frame: 0 };
  }
  deleteBuffer() {
    this.buffers--;
  }
  bindBuffer(_: number, buffer: { frame: number } | null) {
    this.#bound = buffer;
  }
  bufferData() {}
  readPixels() {
    this.#bound!.frame = ++this.#read;
  }
  getBufferSubData(_: number, __: number, to: Uint8Array) {
    to.fill(this.#bound!.frame);
  }
  fenceSync() {
    return { frame: this.#read };
  }
  getSyncParameter(fence: { frame: number }) {
    return fence.frame <= this.drawn ? this.SIGNALED : 0;
  }
  deleteSync() {}
  flush() {}
  isContextLost() {
    return this.isLost;
  }
}

const size = { width: 2, height: 1 };

function start() {
  const gl = new FakeContext();
  const shown: number[] = [];
  const context = gl as unknown as WebGL2RenderingContext;
  const reader = new FrameReader(context, new GpuQueue(context));
  return { gl, shown, reader, read: () => reader.read(size, (pixels) => shown.push(pixels[0]!)) };
}

describe("frames that are read back", () => {
  it("arrive once they are drawn, in order", async () => {
    const { gl, shown, read } = start();
    const frames = [read(), read()];
    await new Promise((resolve) => setTimeout(resolve, 20));
    expect(shown).toEqual([]);
    gl.drawn = 2;
    await Promise.all(frames);
    expect(shown).toEqual([1, 2]);
  });

  it("leave no buffer behind, whatever their size", async () => {
    const { gl, shown, reader, read } = start();
    gl.drawn = 2;
    await read();
    await reader.read({ width: 4, height: 4 }, (pixels) => shown.push(pixels.length));
    expect(gl.buffers).toBe(0);
    expect(shown).toEqual([1, 64]);
  });

  it("are discarded if the context is lost, and read again after it is restored", async () => {
    const { gl, shown, reader, read } = start();
    const frame = read();
    gl.isLost = true;
    await frame;
    reader.forget();
    gl.isLost = false;
    gl.drawn = 2;
    await read();
    expect(shown).toEqual([2]);
  });

  it("are discarded if it was lost and restored meanwhile", async () => {
    const { gl, shown, reader, read } = start();
    const frame = read();
    reader.forget();
    gl.drawn = 1;
    await frame;
    expect(shown).toEqual([]);
  });
});
