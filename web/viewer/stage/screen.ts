/** One WebGL context and its resources: the renderer, its queue, the room that materials reflect, the canvas's memory. */

import {
  BasicShadowMap,
  NeutralToneMapping,
  PMREMGenerator,
  type Texture,
  WebGLRenderer,
  type WebGLRenderTarget,
} from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { FrameReader } from "./frame_reader";
import { GpuQueue } from "./gpu_queue";
import { graphics } from "./graphics";
import { IdleTask } from "./idle_task";
import { pixelRatio, QUALITY_LEVELS, QualityGovernor } from "./quality";

/** Initial quality of a renderer without a GPU. */
const SOFTWARE_LEVEL = 2;

/** Default initial level of quality of a screen. */
export function firstLevel(): number {
  return graphics() === "software" ? SOFTWARE_LEVEL : 0;
}

/** Maximum number of queued frames; more would only add latency. */
const MAX_FRAMES = 2;

/**
 * Threshold of slow frames, milliseconds. If frames are slower, a shared screen leaves time for others: it queues one
 * frame at a time, and if several stages draw, the page gets half as long again as they took.
 */
const SLOW_MS = 12;
const PAGE_SHARE = 1.5;

/**
 * A screen of one stage releases memory after enough consecutive pictures that need less than this share of it, because
 * compositing the canvas takes time for all of it.
 */
const LEAST_USED = 0.2;
const SPARE_FRAMES = 60;

/** Longest wait for the GPU to become idle before the canvas gets new memory, milliseconds. */
const IDLE_TIMEOUT_MS = 2000;

/** An object that draws on a screen. */
export interface Drawn {
  /** The context was lost and restored: everything that the screen drew for this object must be drawn again. */
  restore(): void;
  /** Whether it is the only one on its screen. */
  alone: boolean;
}

/** Size of a picture. */
export interface Size {
  width: number;
  height: number;
}

/** Options of a screen. */
interface ScreenOptions {
  /** Whether edges are smoothed by multisampling. */
  antialias: boolean;
  /**
   * Whether the canvas's memory is kept, and a smaller picture uses its lower left part. Allocating new memory waits
   * for the GPU, which is slow without a graphics card.
   */
  keepsMemory: boolean;
  /** Pixels that are allocated from the start. */
  size?: Size;
  /** Whether several stages may draw on it. */
  isShared?: boolean;
  /** Initial level of quality, 0 being the best; by default chosen for the renderer. */
  level?: number | undefined;
  /** Whether it is made while the page is loading. */
  isLoading?: boolean;
}

/**
 * Creates the context of a canvas, of the size in `options`.
 * @throws if WebGL 2 is missing
 */
function contextOf(canvas: HTMLCanvasElement, { antialias, size }: ScreenOptions): WebGL2RenderingContext {
  const context = Object.assign(canvas, size).getContext("webgl2", {
    antialias,
    stencil: true,
    powerPreference: "high-performance",
  });
  if (!context) throw new Error("WebGL 2 is missing.");
  return context;
}

/** A context on which one stage draws, or several in turn. Browsers have few contexts, so pages with many figures share one. */
export class Screen {
  /** Created in advance for the first stage with a screen of its own. */
  static #prepared: Screen | undefined;
  readonly canvas: HTMLCanvasElement;
  readonly renderer: WebGLRenderer;
  readonly #keepsMemory: boolean;
  /** Consecutive pictures that needed little of the canvas's memory. */
  #spareFrames = 0;
  /** Chooses the quality of everything drawn here, by the mean frame rate of the users. */
  readonly governor: QualityGovernor;
  readonly #isShared: boolean;
  readonly #gl: WebGL2RenderingContext;
  readonly #queue: GpuQueue;
  /** Reads frames back; only without a GPU, where a canvas that displays them itself may block the page. */
  readonly reader: FrameReader | undefined;
  readonly #users = new Set<Drawn>();
  readonly #listeners = new AbortController();
  /** Programs whose uniforms and attributes three.js has queried. */
  readonly #queried = new WeakSet<object>();
  #environment: WebGLRenderTarget | undefined;
  readonly #idleTask = new IdleTask();
  #counting = false;

  private constructor(
    options: ScreenOptions,
    canvas = document.createElement("canvas"),
    context = contextOf(canvas, options),
  ) {
    const { antialias, keepsMemory, level, isShared = false, isLoading = false } = options;
    this.canvas = canvas;
    this.#isShared = isShared;
    this.#keepsMemory = keepsMemory;
    this.governor = new QualityGovernor(level ?? firstLevel(), { isLoading });
    this.renderer = new WebGLRenderer({ canvas, context, antialias, stencil: true });
    // three.js treats a given context with alpha, as it creates itself, as a transparent canvas.
    this.renderer.setClearAlpha(1);
    const { renderer } = this;
    renderer.toneMapping = NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = BasicShadowMap;
    renderer.shadowMap.autoUpdate = false;
    // A frame has two passes; both are counted.
    renderer.info.autoReset = false;
    // Each check is a synchronous call. An invalid shader draws nothing, and the console reports it.
    renderer.debug.checkShaderErrors = false;
    // The first query of an extension is a synchronous call; here the queue is still empty.
    renderer.capabilities.getMaxAnisotropy();
    this.#gl = context;
    this.#queue = new GpuQueue(this.#gl);
    if (graphics() === "software") this.reader = new FrameReader(this.#gl, this.#queue);
    // three.js restores its own resources from memory. The room was drawn by the lost context and must be drawn again.
    const restore = () => {
      this.#queue.forget();
      this.reader?.forget();
      this.#dropEnvironment();
      for (const user of this.#users) user.restore();
    };
    canvas.addEventListener("webglcontextrestored", restore, { signal: this.#listeners.signal });
  }

  /** Name of the renderer as reported by the browser; empty if it reports none. */
  get drawnBy(): string {
    const info = this.#gl.getExtension("WEBGL_debug_renderer_info");
    return String(this.#gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : this.#gl.RENDERER) ?? "");
  }

  /** Prepares in steps the screen that {@link own} gives to the first stage, for a picture of this size in CSS pixels. */
  static *prepare(picture: Size): Generator<undefined> {
    const options = { ...Screen.#ownOptions(undefined, picture), isLoading: true };
    const canvas = document.createElement("canvas");
    const context = contextOf(canvas, options);
    yield;
    Screen.#prepared = new Screen(options, canvas, context);
  }

  /** A screen for one stage of the page's size. */
  static own(level: number | undefined): Screen {
    const prepared = Screen.#prepared;
    if (prepared && level === undefined) {
      Screen.#prepared = undefined;
      return prepared;
    }
    return new Screen(Screen.#ownOptions(level, { width: innerWidth, height: innerHeight }));
  }

  static #ownOptions(level: number | undefined, { width, height }: Size): ScreenOptions {
    if (graphics() !== "software") return { antialias: true, keepsMemory: false, level };
    const ratio = pixelRatio(QUALITY_LEVELS[SOFTWARE_LEVEL]!, width * height, devicePixelRatio, true);
    const size = { width: Math.ceil(width * ratio), height: Math.ceil(height * ratio) };
    return { antialias: level === 0, keepsMemory: true, size, level };
  }

  /** A screen that many stages share, on a page with other content than figures. */
  static shared(): Screen {
    return new Screen({ antialias: graphics() !== "software", keepsMemory: true, isShared: true });
  }

  /** Whether the context is lost. */
  get isLost(): boolean {
    return this.#gl.isContextLost();
  }

  /** Registers an object that draws here. */
  add(user: Drawn): void {
    this.#users.add(user);
    this.#tellWhoIsAlone();
  }

  /** Unregisters it. */
  remove(user: Drawn): void {
    this.#users.delete(user);
    this.#tellWhoIsAlone();
  }

  #tellWhoIsAlone(): void {
    for (const user of this.#users) user.alone = this.#users.size === 1;
  }

  /** Whether nothing can be drawn now: enough frames are queued, the queue is being awaited, or it is the page's turn. */
  get busy(): boolean {
    if (this.#idleTask.isWaiting) return true;
    const { frames } = this.#queue;
    const { at, tookMs } = this.#queue.last;
    const leavesRoom = this.#isShared && tookMs > SLOW_MS;
    const rests = leavesRoom && this.#users.size > 1 && performance.now() - at < PAGE_SHARE * tookMs;
    return rests || frames >= (leavesRoom ? 1 : MAX_FRAMES);
  }

  /** Sets the size of the next picture, in pixels. */
  expect(width: number, height: number): void {
    const { canvas } = this;
    const used = (width * height) / (canvas.width * canvas.height);
    this.#spareFrames = !this.#isShared && used > 0 && used < LEAST_USED ? this.#spareFrames + 1 : 0;
  }

  /** Whether excess memory of the canvas is kept. */
  get #keeps(): boolean {
    return this.#keepsMemory && this.#spareFrames < SPARE_FRAMES;
  }

  /** Whether the canvas's memory fits a picture, in pixels. */
  fits(width: number, height: number): boolean {
    const { canvas } = this;
    if (this.#keeps || width * height === 0) return canvas.width >= width && canvas.height >= height;
    return canvas.width === width && canvas.height === height;
  }

  /** Whether the canvas may get new memory in this task. */
  get mayResize(): boolean {
    return this.#idleTask.isAllowed;
  }

  /** Waits until the GPU is idle; `then` draws in the same task, in which new memory may be allocated. */
  whenIdle(then: () => void): Promise<void> {
    return this.#idleTask.run(() => this.#queue.idle(IDLE_TIMEOUT_MS), then);
  }

  /** Allocates the canvas's memory for a picture, in pixels. */
  resize(width: number, height: number): void {
    const former = this.#keeps ? this.canvas : { width: 0, height: 0 };
    this.renderer.setDrawingBufferSize(Math.max(width, former.width), Math.max(height, former.height), 1);
  }

  /** Counts everything drawn in this task as one frame of the queue. */
  addFrame(): void {
    if (this.#counting) return;
    this.#counting = true;
    queueMicrotask(() => {
      this.#counting = false;
      this.#queue.addFrame();
    });
  }

  /** The room that physical materials reflect. */
  get environment(): Texture {
    this.#environment ??= this.#lightRoom();
    return this.#environment.texture;
  }

  #lightRoom(): WebGLRenderTarget {
    const generator = new PMREMGenerator(this.renderer);
    const room = new RoomEnvironment();
    const environment = generator.fromScene(room, 0.04, 0.1, 100, { size: 64 });
    room.dispose();
    generator.dispose();
    return environment;
  }

  #dropEnvironment(): void {
    this.#environment?.dispose();
    this.#environment = undefined;
  }

  /**
   * Queries uniforms and attributes of new programs before anything is drawn; later each query would wait for the
   * frames before it. Waits at most `timeoutMs`; stops when `current` returns false.
   */
  async queryPrograms(timeoutMs: number, current: () => boolean): Promise<void> {
    const programs = (this.renderer.info.programs ?? []).filter((program) => !this.#queried.has(program));
    if (programs.length === 0) return;
    // WebGL has no fence for linking; validation comes after linking in the queue.
    for (const { program } of programs) this.#gl.validateProgram(program as WebGLProgram);
    await this.#queue.idle(timeoutMs);
    // A program may have been deleted meanwhile. In separate tasks these queries would wait for each other's drawing.
    for (const program of programs.filter(({ program }) => current() && program !== undefined)) {
      program.getUniforms();
      program.getAttributes();
      this.#queried.add(program);
    }
  }

  /** Releases the context now, not when its canvas is garbage-collected: browsers have few contexts. */
  dispose(): void {
    this.#listeners.abort();
    this.reader?.forget();
    this.#dropEnvironment();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
  }
}
