/** One WebGL context and what belongs to it: the renderer, its queue, the room that materials reflect, the canvas's memory. */

import {
  BasicShadowMap,
  NeutralToneMapping,
  PMREMGenerator,
  type Texture,
  WebGLRenderer,
  type WebGLRenderTarget,
} from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { GpuQueue } from "./gpu_queue";
import { graphics } from "./graphics";
import { pixelRatio, QUALITY_LEVELS, QualityGovernor } from "./quality";

/** Quality that a renderer without a graphics processor starts with. */
const SOFTWARE_LEVEL = 2;

/** Level of quality that a screen begins with unless it is told. */
export function firstLevel(): number {
  return graphics() === "software" ? SOFTWARE_LEVEL : 0;
}

/** Frames that may be queued: more would only add latency. */
const MAX_FRAMES = 2;

/**
 * Where frames take longer than this, milliseconds, a shared screen leaves room for others: it queues one at a time, and where
 * several stages draw, the page is given half as long again as they took to draw itself.
 */
const SLOW_MS = 12;
const PAGE_SHARE = 1.5;

/**
 * A screen of one stage gives memory back after so many pictures in a row that need less than this share of it: what shows the
 * canvas takes time for all of it.
 */
const LEAST_USED = 0.2;
const SPARE_FRAMES = 60;

/** Longest wait for the graphics processor to become idle before the canvas gets new memory, milliseconds. */
const IDLE_TIMEOUT_MS = 2000;

/** What draws on a screen. */
export interface Drawn {
  /** The context was lost and restored: what the screen drew for it must be drawn again. */
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
export interface ScreenOptions {
  /** Whether edges are smoothed by multisampling. */
  antialias: boolean;
  /**
   * Whether the canvas's memory is kept, and a smaller picture has its lower left part: new memory is had from the graphics
   * processor, and without a graphics card that has to be waited for.
   */
  keepsMemory: boolean;
  /** Pixels that have memory from the start. */
  size?: Size;
  /** Whether several stages may draw on it. */
  isShared?: boolean;
  /** Level of quality to begin with, 0 being the best; by default what the renderer suggests. */
  level?: number | undefined;
  /** Whether it is made while the page is loading. */
  isLoading?: boolean;
}

/**
 * Makes the context of a canvas, of the size that `options` ask for.
 * @throws where WebGL 2 is missing
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

/** A context that one stage draws on, or several in turn. Browsers have few contexts: pages with many figures share one. */
export class Screen {
  /** Made ahead for the first stage with a screen of its own. */
  static #prepared: Screen | undefined;
  readonly canvas: HTMLCanvasElement;
  readonly renderer: WebGLRenderer;
  readonly #keepsMemory: boolean;
  /** Pictures in a row that needed little of the canvas's memory. */
  #spareFrames = 0;
  /** Decides about the quality of all that is drawn here, by the mean rate of those that draw. */
  readonly governor: QualityGovernor;
  readonly #isShared: boolean;
  readonly #gl: WebGL2RenderingContext;
  readonly #queue: GpuQueue;
  readonly #users = new Set<Drawn>();
  readonly #listeners = new AbortController();
  /** Programs whose uniforms and attributes three.js has looked up. */
  readonly #queried = new WeakSet<object>();
  #environment: WebGLRenderTarget | undefined;
  /** Whether synchronous calls are allowed now, the queue is being waited for, or neither. */
  #synchronous: "allowed" | "waiting" | "none" = "none";
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
    // three.js takes a context with alpha, as its own are, for a canvas that the page shows through.
    this.renderer.setClearAlpha(1);
    const { renderer } = this;
    renderer.toneMapping = NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = BasicShadowMap;
    renderer.shadowMap.autoUpdate = false;
    // A frame is two passes; both count.
    renderer.info.autoReset = false;
    // Each check is a synchronous call. A shader that is wrong draws nothing, and the console says so.
    renderer.debug.checkShaderErrors = false;
    // The first query of an extension is a synchronous call: here nothing is waiting to be drawn.
    renderer.capabilities.getMaxAnisotropy();
    this.#gl = context;
    this.#queue = new GpuQueue(this.#gl);
    // three.js restores what it made from memory; the room was drawn by the lost context and must be drawn again.
    const restore = () => {
      this.#queue.forget();
      this.#dropEnvironment();
      for (const user of this.#users) user.restore();
    };
    canvas.addEventListener("webglcontextrestored", restore, { signal: this.#listeners.signal });
  }

  /** What draws, by the name that the browser gives it; empty where it tells none. */
  get drawnBy(): string {
    const info = this.#gl.getExtension("WEBGL_debug_renderer_info");
    return String(this.#gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : this.#gl.RENDERER) ?? "");
  }

  /** Makes ahead what {@link own} gives to the first stage, in steps, for a picture of this size in CSS pixels. */
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

  /** A screen that many stages share, on a page that has more to draw than figures. */
  static shared(): Screen {
    return new Screen({ antialias: graphics() !== "software", keepsMemory: true, isShared: true });
  }

  /** Whether the context is lost. */
  get isLost(): boolean {
    return this.#gl.isContextLost();
  }

  /** Lets something draw here. */
  add(user: Drawn): void {
    this.#users.add(user);
    this.#tellWhoIsAlone();
  }

  /** Lets it draw no longer. */
  remove(user: Drawn): void {
    this.#users.delete(user);
    this.#tellWhoIsAlone();
  }

  #tellWhoIsAlone(): void {
    for (const user of this.#users) user.alone = this.#users.size === 1;
  }

  /** Whether nothing can be drawn now: enough is queued, the queue is being waited for, or it is the page's turn. */
  get busy(): boolean {
    if (this.#synchronous === "waiting") return true;
    const { frames } = this.#queue;
    const { at, tookMs } = this.#queue.last;
    const leavesRoom = this.#isShared && tookMs > SLOW_MS;
    const rests = leavesRoom && this.#users.size > 1 && performance.now() - at < PAGE_SHARE * tookMs;
    return rests || frames >= (leavesRoom ? 1 : MAX_FRAMES);
  }

  /** Takes the size of the next picture, in pixels. */
  expect(width: number, height: number): void {
    const { canvas } = this;
    const used = (width * height) / (canvas.width * canvas.height);
    this.#spareFrames = !this.#isShared && used > 0 && used < LEAST_USED ? this.#spareFrames + 1 : 0;
  }

  /** Whether what the canvas has too much of is kept. */
  get #keeps(): boolean {
    return this.#keepsMemory && this.#spareFrames < SPARE_FRAMES;
  }

  /** Whether the canvas has the right memory for a picture, in pixels. */
  fits(width: number, height: number): boolean {
    const { canvas } = this;
    if (this.#keeps || width * height === 0) return canvas.width >= width && canvas.height >= height;
    return canvas.width === width && canvas.height === height;
  }

  /** Whether the canvas may get new memory in this task. */
  get mayResize(): boolean {
    return this.#synchronous === "allowed";
  }

  /** Waits until the graphics processor has nothing to do; `then` draws in the same task, in which new memory is allowed. */
  async whenIdle(then: () => void): Promise<void> {
    this.#synchronous = "waiting";
    await this.#queue.idle(IDLE_TIMEOUT_MS);
    this.#synchronous = "allowed";
    try {
      then();
    } finally {
      this.#synchronous = "none";
    }
  }

  /** Gives the canvas memory for a picture, in pixels. */
  resize(width: number, height: number): void {
    const former = this.#keeps ? this.canvas : { width: 0, height: 0 };
    this.renderer.setDrawingBufferSize(Math.max(width, former.width), Math.max(height, former.height), 1);
  }

  /** Counts what was drawn in this task as one frame of the queue. */
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
   * Queries uniforms and attributes of new programs before anything is drawn: later each query would wait for the frames
   * before it. Waits `timeoutMs` at most; gives up where `current` says so.
   */
  async queryPrograms(timeoutMs: number, current: () => boolean): Promise<void> {
    const programs = (this.renderer.info.programs ?? []).filter((program) => !this.#queried.has(program));
    if (programs.length === 0) return;
    // WebGL has no fence for linking; validation comes after it in the queue.
    for (const { program } of programs) this.#gl.validateProgram(program as WebGLProgram);
    await this.#queue.idle(timeoutMs);
    // A program may have been deleted meanwhile. In tasks of their own these queries would wait for each other's drawing.
    for (const program of programs.filter(({ program }) => current() && program !== undefined)) {
      program.getUniforms();
      program.getAttributes();
      this.#queried.add(program);
    }
  }

  /** Releases the context now, not when its canvas is collected: browsers have few of them. */
  dispose(): void {
    this.#listeners.abort();
    this.#dropEnvironment();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
  }
}
