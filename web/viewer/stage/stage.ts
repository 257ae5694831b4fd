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
import type { Theme } from "../themes";
import { Background } from "./background";
import { Footprints } from "./footprints";
import { Ground } from "./ground";
import { HipsPath } from "./hips_path";
import { Labels } from "./labels";
import { Lights } from "./lights";
import { type CameraView, OrbitCamera } from "./orbit_camera";
import { pixelRatio, QUALITY_LEVELS, QualityGovernor, type QualityLevel } from "./quality";
import { ShadeMap } from "./shade_map";

/** Renderers that have no graphics processor behind them. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|basic render|software/i;
/** Quality that a renderer without a graphics processor starts with. */
const SOFTWARE_LEVEL = 2;

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
  readonly #root = document.createElement("div");
  readonly #renderer: WebGLRenderer;
  readonly #lights = new Lights();
  readonly #background = new Background();
  readonly #observer: ResizeObserver;
  readonly #listeners = new AbortController();
  #theme: Theme | undefined;
  #environment: WebGLRenderTarget | undefined;
  #still = false;
  #columns = 1;
  #width = 1;
  #height = 1;

  /** `level` of {@link QUALITY_LEVELS} to begin with; by default what the renderer suggests. */
  constructor(container: HTMLElement, level?: number) {
    this.#root.style.cssText = "position:relative;width:100%;height:100%;overflow:hidden";
    this.#renderer = new WebGLRenderer({
      antialias: level === 0 || !isSoftware(),
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
    this.canvas = renderer.domElement;
    this.canvas.style.cssText = "display:block;position:absolute;inset:0;touch-action:pan-y";
    this.canvas.setAttribute("role", "img");
    this.canvas.tabIndex = 0;
    this.#root.append(this.canvas, this.labels.element);
    container.append(this.#root);

    this.view = new OrbitCamera(this.canvas);
    this.governor = new QualityGovernor(level ?? (isSoftware() ? SOFTWARE_LEVEL : 0));
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
      this.#dropRoom();
      this.applyQuality();
      this.onInvalid?.();
    };
    this.canvas.addEventListener("webglcontextrestored", restore, { signal: this.#listeners.signal });
    this.#observer = new ResizeObserver(() => {
      this.#resize();
      this.onInvalid?.();
    });
    this.#observer.observe(this.#root);
    this.#resize();
  }

  /** Level of quality in force. */
  get quality(): QualityLevel {
    return QUALITY_LEVELS[this.governor.level]!;
  }

  /** Size of the picture in CSS pixels. */
  get size(): { width: number; height: number } {
    return { width: this.#width, height: this.#height };
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
    this.#resize();
    this.onQuality?.(quality);
  }

  /** Goes to a view of something that faces `heading`, gliding unless the user asked for less motion. */
  setView(view: CameraView, heading: number): void {
    this.view.setView(view, heading, !matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  /** Whether the picture stands still: it is then drawn with more pixels. */
  set still(still: boolean) {
    if (still === this.#still) return;
    this.#still = still;
    this.#resize();
  }

  get still(): boolean {
    return this.#still;
  }

  /** Number of columns that the picture is divided into; the camera's picture fills one of them. */
  set columns(columns: number) {
    if (columns === this.#columns) return;
    this.#columns = columns;
    this.#resize();
  }

  /** Compiles the shaders of the scene, all at once and beside other work; resolves when they are ready. */
  async compile(): Promise<void> {
    await this.#renderer.compileAsync(this.scene, this.view.camera);
  }

  /** Draws the scene into a column; `dtSecs` since the last frame, the light on `subject`. */
  render(dtSecs: number, subject: Vector3, column = 0): void {
    if (column === 0 && !this.#still && this.governor.frame(dtSecs)) this.applyQuality();
    this.#renderer.info.reset();
    this.#lights.follow(subject, this.view.azimuth);
    // The shade map's pass draws the light's shadow map too; the picture's pass finds it there.
    this.#renderer.shadowMap.needsUpdate = true;
    this.shade.render(this.#renderer, this.scene, middle.lerpVectors(subject, this.view.target, 0.5));
    this.#ground.follow(this.view.target);
    if (this.#columns > 1) {
      const width = this.#width / this.#columns;
      this.#renderer.setViewport(column * width, 0, width, this.#height);
      this.#renderer.setScissor(column * width, 0, width, this.#height);
    }
    this.#renderer.render(this.scene, this.view.camera);
  }

  /** Place of a point of the world (metres) in the picture, CSS pixels from the canvas's top left. */
  project(point: Vector3): { x: number; y: number } {
    const p = projected.copy(point).project(this.view.camera);
    return { x: ((p.x + 1) / 2) * this.#width, y: ((1 - p.y) / 2) * this.#height };
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
    this.#root.remove();
  }

  /** Draws the room that physical materials reflect; nobody else pays for it. */
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

  #resize(): void {
    const { clientWidth, clientHeight } = this.#root;
    if (!clientWidth || !clientHeight) return;
    this.#width = clientWidth;
    this.#height = clientHeight;
    const ratio = pixelRatio(this.quality, clientWidth * clientHeight, devicePixelRatio, this.#still);
    const { canvas } = this;
    // Every assignment to the canvas's size gives it new memory, once the pictures before it are drawn: one each at most.
    const unchanged =
      canvas.width === Math.floor(clientWidth * ratio) && canvas.height === Math.floor(clientHeight * ratio);
    if (!unchanged || this.#renderer.getPixelRatio() !== ratio)
      this.#renderer.setDrawingBufferSize(clientWidth, clientHeight, ratio);
    canvas.style.width = `${clientWidth}px`;
    canvas.style.height = `${clientHeight}px`;
    this.#renderer.setScissorTest(this.#columns > 1);
    this.view.resize(clientWidth / this.#columns, clientHeight);
  }
}

const projected = new Vector3();
const middle = new Vector3();

let software: boolean | undefined;

/** Whether WebGL runs on the processor; asked once, of a context of its own, as multisampling must be chosen before. */
function isSoftware(): boolean {
  software ??= detectSoftware();
  return software;
}

function detectSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return true;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name);
}
