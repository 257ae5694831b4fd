/**
 * Frames that the graphics processor has been given and not drawn yet, by fences. A synchronous WebGL call, such as an
 * allocation or a query of a shader's uniforms, blocks the page until all of them are drawn: without a graphics card that
 * may be half a second.
 */

/** A fence that is signalled within this time found the queue empty, milliseconds. */
const QUICK_MS = 24;
/** Interval at which a fence is polled, milliseconds. */
const POLL_MS = 4;

/** A frame that is not drawn yet. */
interface Queued {
  fence: WebGLSync;
  /** When its commands were given, milliseconds. */
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

  /** Counts the frame whose commands were just given. */
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

  /** When the last frame was found drawn, and how long it had taken, milliseconds. */
  get last(): Readonly<{ at: number; tookMs: number }> {
    return this.#last;
  }

  /** Resolves when this context's frames are drawn and the work of other contexts too, for which it waits `timeoutMs` at most. */
  async idle(timeoutMs: number): Promise<void> {
    await this.#latency();
    const until = performance.now() + timeoutMs;
    while ((await this.#latency()) > QUICK_MS && performance.now() < until);
  }

  /** How long a fence takes to be signalled, milliseconds. */
  async #latency(): Promise<number> {
    const begun = performance.now();
    const fence = this.#fence();
    while (fence && !this.#passed(fence)) await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    return performance.now() - begun;
  }

  /** Forgets the frames of a context that was lost. */
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
