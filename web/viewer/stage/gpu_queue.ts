/**
 * What the graphics processor has before it. Whatever asks it a question, such as for new memory or for what a shader
 * takes, waits for all of that, the rest of the page included: without a graphics card that may be half a second.
 */

/** A fence that comes back within this time found nothing before it, milliseconds. */
const QUICK_MS = 24;
/** A fence is looked at this often, milliseconds. */
const LOOK_MS = 4;

export class GpuQueue {
  readonly #gl: WebGL2RenderingContext;
  #frames: WebGLSync[] = [];

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
  }

  /** Counts the frame whose commands were just given. */
  addFrame(): void {
    const fence = this.#fence();
    if (fence) this.#frames.push(fence);
  }

  /** Number of frames that are not drawn yet; it changes between tasks only. */
  get frames(): number {
    this.#frames = this.#frames.filter((fence) => !this.#passed(fence));
    return this.#frames.length;
  }

  /** Resolves when what it was given is done and, unless that takes longer than `patienceMs`, others' work is too. */
  async idle(patienceMs: number): Promise<void> {
    await this.#answer();
    const until = performance.now() + patienceMs;
    while ((await this.#answer()) > QUICK_MS && performance.now() < until);
  }

  /** How long a fence takes to come back, milliseconds. */
  async #answer(): Promise<number> {
    const asked = performance.now();
    const fence = this.#fence();
    while (fence && !this.#passed(fence)) await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
    return performance.now() - asked;
  }

  /** Forgets what a context had that was lost. */
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
