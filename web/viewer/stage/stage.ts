/** The renderer and everything in the scene but the characters. */

import {
  BasicShadowMap,
  NeutralToneMapping,
  PMREMGenerator,
  Scene,
  Vector3,
  WebGLRenderer,
  type WebGLRenderTarget,
} from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { Lights } from "../light/lights";
import type { Theme } from "../themes";
import { Background } from "./background";
import { Footprints } from "./footprints";
import { GpuQueue } from "./gpu_queue";
import { graphics } from "./graphics";
import { Ground } from "./ground";
import { HipsPath } from "./hips_path";
import { Labels } from "./labels";
import { type CameraView, OrbitCamera } from "./orbit_camera";
import { pixelRatio, QUALITY_LEVELS, QualityGovernor, type QualityLevel } from "./quality";
import { ShadeMap } from "./shade_map";

/** Quality that a renderer without a graphics processor starts with. */
const SOFTWARE_LEVEL = 2;

/** Attribute of a canvas on which the finer picture of what stands still is: there is nothing left to draw. */
const STILL = "data-still";

/** Frames that may be queued: more would only add latency. */
const MAX_FRAMES = 2;

/** Longest waits for the graphics processor to become idle, milliseconds. */
const TIMEOUT_MS = { memory: 2000, firstShaders: 300, shaders: 2000 };

/** Scene, camera, light and ground. */
export class Stage {
  readonly canvas: HTMLCanvasElement;
  readonly scene = new Scene();
  readonly shade = new ShadeMap();
  readonly #ground = new Ground(this.shade.texture, this.shade.centre);
  readonly footprints = new Footprints();
  readonly path = new HipsPath();
  readonly labels = new Labels();
  readonly view: OrbitCamera;
  readonly governor: QualityGovernor;
  /** Called when the quality changes, and once at the start. */
  onQuality: ((level: QualityLevel) => void) | undefined;
  /** Called when the picture must be drawn again: it has another size, or its context was lost and restored. */
  onInvalid: (() => void) | undefined;
  /** Called when a frame that was put off can be drawn, but only at once. */
  onIdle: (() => void) | undefined;
  readonly #root = document.createElement("div");
  readonly #renderer: WebGLRenderer;
  readonly #lights = new Lights();
  readonly #background = new Background();
  readonly #observer: ResizeObserver;
  readonly #listeners = new AbortController();
  #theme: Theme | undefined;
  #environment: WebGLRenderTarget | undefined;
  #still = false;
  readonly #gl: WebGL2RenderingContext;
  readonly #queue: GpuQueue;
  /** Programs whose uniforms and attributes three.js has looked up. */
  readonly #queried = new WeakSet<object>();
  /** Whether synchronous calls are allowed now, the queue is being waited for, or neither. */
  #synchronous: "allowed" | "waiting" | "none" = "none";
  #compiled = false;
  #compilation = 0;
  /** Seconds since the last frame. */
  #elapsed = 0;
  #columns = 1;
  /**
   * Whether the canvas's memory is never given back, and a smaller picture has its lower left part: new memory is had from
   * the graphics processor, and without a graphics card that has to be waited for.
   */
  readonly #keepsMemory: boolean;
  /** Size of the picture, CSS pixels. */
  #size = { width: 1, height: 1 };
  /** The same in pixels of the canvas. */
  #pixels = { width: 1, height: 1 };

  /** `level` of {@link QUALITY_LEVELS} to begin with; by default what the renderer suggests. */
  constructor(container: HTMLElement, level?: number) {
    this.#root.style.cssText = "position:relative;width:100%;height:100%;overflow:hidden";
    const canvas = document.createElement("canvas");
    this.#keepsMemory = graphics() === "software";
    if (this.#keepsMemory) {
      const ratio = pixelRatio(QUALITY_LEVELS[SOFTWARE_LEVEL]!, innerWidth * innerHeight, devicePixelRatio, true);
      [canvas.width, canvas.height] = [Math.ceil(innerWidth * ratio), Math.ceil(innerHeight * ratio)];
    }
    this.#renderer = new WebGLRenderer({
      canvas,
      antialias: level === 0 || !this.#keepsMemory,
      stencil: true,
      powerPreference: "high-performance",
    });
    const renderer = this.#renderer;
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
    this.#gl = renderer.getContext() as WebGL2RenderingContext;
    this.#queue = new GpuQueue(this.#gl);
    this.canvas = canvas;
    this.canvas.style.cssText = "display:block;position:absolute;left:0;bottom:0;touch-action:pan-y";
    // It takes the arrow keys, which no picture does; its label says what is seen.
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-keyshortcuts", "ArrowLeft ArrowRight ArrowUp ArrowDown + -");
    this.canvas.tabIndex = 0;
    this.#root.append(this.canvas, this.labels.element);
    container.append(this.#root);

    this.view = new OrbitCamera(this.canvas);
    this.governor = new QualityGovernor(level ?? (graphics() === "software" ? SOFTWARE_LEVEL : 0));
    this.scene.add(
      this.#background.object,
      this.#lights.object,
      this.#ground.object,
      this.shade.object,
      this.footprints.object,
      this.path.behind.mesh,
      this.path.ahead.mesh,
    );
    // three.js restores what it made from memory; the room was drawn by the lost context and must be drawn again.
    const restore = () => {
      this.#queue.forget();
      this.#dropRoom();
      this.applyQuality();
      this.onInvalid?.();
    };
    this.canvas.addEventListener("webglcontextrestored", restore, { signal: this.#listeners.signal });
    this.#observer = new ResizeObserver(() => {
      this.#measure();
      this.onInvalid?.();
    });
    this.#observer.observe(this.#root);
    this.#measure();
  }

  /** Level of quality in force. */
  get quality(): QualityLevel {
    return QUALITY_LEVELS[this.governor.level]!;
  }

  /** Size of the picture in CSS pixels. */
  get size(): Readonly<{ width: number; height: number }> {
    return this.#size;
  }

  /** A copy of the picture; only right after it was drawn. */
  copy(): HTMLCanvasElement {
    const copy = document.createElement("canvas");
    const { width, height } = Object.assign(copy, this.#pixels);
    copy.getContext("2d")!.drawImage(this.canvas, 0, this.canvas.height - height, width, height, 0, 0, width, height);
    return copy;
  }

  /** Triangles and draw calls of the last frame, shadow pass included. */
  get cost(): { triangles: number; calls: number } {
    const { triangles, calls } = this.#renderer.info.render;
    return { triangles, calls };
  }

  /** Takes the theme's colours and light levels; nothing is rebuilt. */
  setTheme(theme: Theme): void {
    this.#theme = theme;
    for (const part of [this.#background, this.#ground, this.footprints, this.path]) part.setTheme(theme);
    this.#lights.setTheme(theme, this.quality.shading);
    this.scene.environmentIntensity = theme.light.environment;
  }

  /** Puts the settings of the present quality into force. */
  applyQuality(): void {
    const { quality } = this;
    this.#lights.shadowSize = quality.shadowSize;
    if (this.#theme) this.#lights.setTheme(this.#theme, quality.shading);
    this.shade.resolution = quality.shadeSize;
    this.shade.shadowTaps = quality.taps;
    if (quality.shading === "physical") this.#lightRoom();
    else this.#dropRoom();
    this.onQuality?.(quality);
    void this.compile();
  }

  /** Compiles what will be drawn, one thing at a time and without waiting for it; nothing is drawn meanwhile. */
  async compile(): Promise<void> {
    const turn = ++this.#compilation;
    const current = () => turn === this.#compilation && !this.#gl.isContextLost();
    this.#compiled = false;
    try {
      await this.#compileScene(current);
      await this.#queryShaders(current);
    } finally {
      if (turn === this.#compilation) {
        this.#compiled = true;
        this.onInvalid?.();
      }
    }
  }

  async #compileScene(current: () => boolean): Promise<void> {
    const renderer = this.#renderer;
    const compiling: Promise<unknown>[] = [this.shade.compile(renderer, this.scene)];
    for (const object of this.scene.children.filter((child) => child !== this.shade.object)) {
      await otherTasks();
      if (!current()) return;
      compiling.push(renderer.compileAsync(object, this.view.camera, this.scene));
    }
    await Promise.all(compiling);
  }

  /** Queries uniforms and attributes before anything is drawn: later each query would wait for the frames before it. */
  async #queryShaders(current: () => boolean): Promise<void> {
    const programs = (this.#renderer.info.programs ?? []).filter((program) => !this.#queried.has(program));
    // WebGL has no fence for linking; validation comes after it in the queue.
    for (const { program } of programs) this.#gl.validateProgram(program as WebGLProgram);
    // The first picture must come soon; later ones may wait.
    await this.#queue.idle(this.#compilation === 1 ? TIMEOUT_MS.firstShaders : TIMEOUT_MS.shaders);
    // A program may have been deleted meanwhile.
    for (const program of programs.filter(({ program }) => current() && program !== undefined)) {
      program.getUniforms();
      program.getAttributes();
      this.#queried.add(program);
    }
  }

  /** Goes to a view of something that faces `heading`, gliding unless the user asked for less motion. */
  setView(view: CameraView, heading: number): void {
    this.view.setView(view, heading, !matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  /** Whether the picture on screen is the finer one of what stands still. */
  get still(): boolean {
    return this.#still;
  }

  /** Number of columns that the picture is divided into; the camera's picture fills one of them. */
  set columns(columns: number) {
    this.#columns = columns;
  }

  /**
   * Begins a frame `dtSecs` after the last call, with more pixels if the picture stands `still`; whether it is
   * to be drawn now. The graphics processor is given few frames at a time, and what it has to be asked is put off until it
   * has nothing to do.
   */
  begin(dtSecs: number, still: boolean): boolean {
    this.#elapsed += dtSecs;
    if (!this.#compiled || this.#synchronous === "waiting" || this.#queue.frames >= MAX_FRAMES) return false;
    const elapsed = this.#elapsed;
    this.#elapsed = 0;
    if (!this.#still && !still && this.governor.frame(elapsed)) {
      this.applyQuality();
      return false;
    }
    if (!this.#fits(still) && this.#synchronous !== "allowed") {
      void this.#whenIdle();
      return false;
    }
    this.#synchronous = "none";
    if (still !== this.#still) this.canvas.toggleAttribute(STILL, still);
    this.#still = still;
    this.#resize();
    this.#renderer.info.reset();
    return true;
  }

  /** Ends a frame of which all columns were drawn. */
  end(): void {
    this.#queue.addFrame();
  }

  /** Draws the scene into a column, the light on `subject`. */
  render(subject: Vector3, column = 0): void {
    this.#lights.follow(subject, this.view.azimuth);
    // The shade map's pass draws the light's shadow map too; the picture's pass finds it there.
    this.#renderer.shadowMap.needsUpdate = true;
    this.shade.render(this.#renderer, this.scene, middle.lerpVectors(subject, this.view.target, 0.5));
    this.#ground.follow(this.view.target);
    const width = this.#pixels.width / this.#columns;
    this.#renderer.setViewport(column * width, 0, width, this.#pixels.height);
    this.#renderer.setScissor(column * width, 0, width, this.#pixels.height);
    this.#renderer.render(this.scene, this.view.camera);
  }

  /** Place of a point of the world (metres) in the picture, CSS pixels from its top left. */
  project(point: Vector3): { x: number; y: number } {
    const p = projected.copy(point).project(this.view.camera);
    return { x: ((p.x + 1) / 2) * this.#size.width, y: ((1 - p.y) / 2) * this.#size.height };
  }

  dispose(): void {
    this.#listeners.abort();
    this.#observer.disconnect();
    for (const part of [
      this.view,
      this.labels,
      this.#lights,
      this.#background,
      this.#ground,
      this.shade,
      this.footprints,
      this.path,
    ])
      part.dispose();
    this.#dropRoom();
    this.#renderer.dispose();
    // The context is released now, not when its canvas is collected: browsers have few of them.
    this.#renderer.forceContextLoss();
    this.#root.remove();
  }

  /** Renders the environment map that physical materials reflect; only these need it. */
  #lightRoom(): void {
    if (this.#environment) return;
    const generator = new PMREMGenerator(this.#renderer);
    const room = new RoomEnvironment();
    this.#environment = generator.fromScene(room, 0.04, 0.1, 100, { size: 64 });
    this.scene.environment = this.#environment.texture;
    room.dispose();
    generator.dispose();
  }

  #dropRoom(): void {
    this.scene.environment = null;
    this.#environment?.dispose();
    this.#environment = undefined;
  }

  async #whenIdle(): Promise<void> {
    this.#synchronous = "waiting";
    await this.#queue.idle(TIMEOUT_MS.memory);
    this.#synchronous = "allowed";
    this.onIdle?.();
  }

  /** Size that the picture should have in pixels of the canvas; nothing while it is hidden. */
  #wanted(still: boolean): { width: number; height: number } {
    const { clientWidth, clientHeight } = this.#root;
    const ratio = pixelRatio(this.quality, clientWidth * clientHeight, devicePixelRatio, still);
    return { width: Math.floor(clientWidth * ratio), height: Math.floor(clientHeight * ratio) };
  }

  /** Whether the canvas has the right memory for that. */
  #fits(still: boolean): boolean {
    const { width, height } = this.#wanted(still);
    const { canvas } = this;
    if (this.#keepsMemory || width * height === 0) return canvas.width >= width && canvas.height >= height;
    return canvas.width === width && canvas.height === height;
  }

  /** Fits the camera to the place of the picture. */
  #measure(): void {
    const { clientWidth: width, clientHeight: height } = this.#root;
    if (!width || !height) return;
    this.#size = { width, height };
    this.view.resize(width / this.#columns, height);
  }

  /** Fits the picture to its place. */
  #resize(): void {
    this.#measure();
    const { width, height } = this.#size;
    const pixels = this.#wanted(this.#still);
    if (pixels.width * pixels.height === 0) return;
    const { canvas } = this;
    // Every assignment to the canvas's size gives it new memory: one each at most.
    if (!this.#fits(this.#still)) {
      const former = this.#keepsMemory ? canvas : { width: 0, height: 0 };
      const memory = { width: Math.max(pixels.width, former.width), height: Math.max(pixels.height, former.height) };
      this.#renderer.setDrawingBufferSize(memory.width, memory.height, 1);
    }
    this.#pixels = pixels;
    canvas.style.width = `${(canvas.width * width) / pixels.width}px`;
    canvas.style.height = `${(canvas.height * height) / pixels.height}px`;
    this.#renderer.setScissorTest(true);
  }
}

/** Lets the page do what it has to do besides. */
function otherTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}

const projected = new Vector3();
const middle = new Vector3();
