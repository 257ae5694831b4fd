/**
 * Counts frames that were submitted to the GPU and are not drawn yet, by fences. A synchronous WebGL call, such as an
 * allocation or a query of a shader's uniforms, blocks the page until all of them are drawn. Without a GPU that may
 * take half a second.
 */

/** A fence that is signalled within this time means that the queue was empty, milliseconds. */
const QUICK_MS = 24;
/** Interval at which a fence is polled, milliseconds. */
const POLL_MS = 4;

/** A frame that is not drawn yet. */
interface Queued {
  fence: WebGLSync;
  /** When its commands were submitted, milliseconds. */
  at: number;
}

/** The queue of one context. */
export class GpuQueue {
  readonly #gl: WebGL2RenderingContext;
  #frames: Queued[] = [];
  #last = { at: 0, tookMs: 0 };

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
  }

  /** Counts the frame whose commands were just submitted. */
  addFrame(): void {
    const fence = this.#fence();
    if (fence) this.#frames.push({ fence, at: performance.now() });
  }

  /** Number of frames that are not drawn yet; it changes between tasks only. */
  get frames(): number {
    const now = performance.now();
    this.#frames = this.#frames.filter(({ fence, at }) => {
      const passed = this.#passed(fence);
      if (passed) this.#last = { at: now, tookMs: now - at };
      return !passed;
    });
    return this.#frames.length;
  }

  /** When the last frame was found to be drawn, and how long it took, milliseconds. */
  get last(): Readonly<{ at: number; tookMs: number }> {
    return this.#last;
  }

  /**
   * Resolves when the frames of this context are drawn, and the work of other contexts too, which is awaited for at
   * most `timeoutMs`.
   */
  async idle(timeoutMs: number): Promise<void> {
    await this.#latency();
    const until = performance.now() + timeoutMs;
    while ((await this.#latency()) > QUICK_MS && performance.now() < until);
  }

  /** How long a fence takes to be signalled, milliseconds. */
  async #latency(): Promise<number> {
    const begun = performance.now();
    await this.finished();
    return performance.now() - begun;
  }

  /** Resolves when all commands that were submitted until now are done, or the context is lost. */
  async finished(): Promise<void> {
    const fence = this.#fence();
    while (fence && !this.#passed(fence)) await new Promise((resolve) => setTimeout(resolve, POLL_MS));
  }

  /** Discards the frames of a lost context. */
  forget(): void {
    this.#frames = [];
  }

  #fence(): WebGLSync | null {
    const fence = this.#gl.fenceSync(this.#gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.#gl.flush();
    return fence;
  }

  #passed(fence: WebGLSync): boolean {
    const gl = this.#gl;
    const passed = gl.isContextLost() || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
    if (passed) gl.deleteSync(fence);
    return passed;
  }
}
