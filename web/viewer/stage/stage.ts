/** Everything in the scene except the characters, and the output of its picture. */

import { type Object3D, Plane, Raycaster, Scene, Vector2, Vector3 } from "three";
import { Lights } from "../light/lights";
import type { Theme } from "../themes";
import { Background } from "./background";
import { Footprints } from "./footprints";
import type { FrameReader } from "./frame_reader";
import { Ground } from "./ground";
import { HipsPath } from "./hips_path";
import { Labels } from "./labels";
import { type CameraRange, type CameraView, OrbitCamera } from "./orbit_camera";
import { onPixelRatio } from "./pixel_ratio";
import { pixelRatio, QUALITY_LEVELS, type QualityLevel } from "./quality";
import { type Drawn, Screen, type Size } from "./screen";
import { ShadeMap } from "./shade_map";
import { otherTasks } from "./tasks";

/** Attribute of a canvas that shows the finer picture of a still scene: there is nothing left to draw. */
const STILL = "data-still";

/** Longest waits for the GPU to become idle before shaders are queried, milliseconds. */
const TIMEOUT_MS = { first: 300, later: 2000 };

/** Options of a stage. */
interface StageOptions {
  /** Initial index into {@link QUALITY_LEVELS}; by default chosen for the renderer. */
  level?: number | undefined;
  /** The screen to draw on, shared with others; by default one of its own. */
  screen?: Screen | undefined;
  /** Range of the camera; by default for one character. */
  camera?: CameraRange;
  /** Whether there is no ground, shade, footprint or path: the scene has its own, and no shadow map is drawn. */
  bare?: boolean;
}

/**
 * Scene, camera, light and ground. A stage with a screen of its own shows the screen's canvas. On a shared screen it
 * draws in the corner of that canvas and copies the picture to a canvas of its own, unless it is alone there. Without a
 * GPU every stage has a canvas of its own, to which its frames are read back.
 */
export class Stage implements Drawn {
  /** The element that receives pointers and keys, and that screen readers find. */
  readonly canvas: HTMLCanvasElement;
  readonly scene = new Scene();
  readonly shade = new ShadeMap();
  readonly #ground = new Ground(this.shade.texture, this.shade.centre);
  readonly footprints = new Footprints();
  readonly path = new HipsPath();
  readonly labels = new Labels();
  readonly view: OrbitCamera;
  /** Called when the quality changes, and once at the start. */
  onQuality: ((level: QualityLevel) => void) | undefined;
  /** Called when the picture must be drawn again: its size has changed, or its context was lost and restored. */
  onInvalid: (() => void) | undefined;
  /** Called when a postponed frame can be drawn, but only at once. */
  onIdle: (() => void) | undefined;
  readonly #root = document.createElement("div");
  readonly #screen: Screen;
  readonly #owns: boolean;
  readonly #bare: boolean;
  /** Whether the screen's canvas is not displayed: frames are copied to one of its own. */
  readonly #copies: boolean;
  /** The copy of the picture. */
  readonly #copy: CanvasRenderingContext2D | undefined;
  /** The picture that was read back. */
  #image: ImageData | undefined;
  #alone = false;
  #level: number;
  readonly #lights = new Lights();
  readonly #background = new Background();
  readonly #observer: ResizeObserver;
  readonly #life = new AbortController();
  #theme: Theme | undefined;
  #hasOthers = false;
  #still = false;
  #compiled = false;
  #compilation = 0;
  /** Seconds since the last frame. */
  #elapsed = 0;
  #columns = 1;
  #filmed: Readonly<Size> | undefined;
  #covered = 0;
  /** Size of the picture, CSS pixels. */
  #size = { width: 1, height: 1 };
  /** The size in pixels of the canvas. */
  #pixels = { width: 1, height: 1 };

  constructor(container: HTMLElement, { level, screen, camera, bare = false }: StageOptions = {}) {
    this.#bare = bare;
    this.#root.style.cssText = "position:relative;width:100%;height:100%;overflow:hidden";
    this.#owns = screen === undefined;
    this.#screen = screen ?? Screen.own(level);
    this.#level = this.#screen.governor.level;
    const reads = this.#screen.reader !== undefined;
    this.#copies = reads || !this.#owns;
    this.canvas = this.#copies ? document.createElement("canvas") : this.#screen.canvas;
    if (this.#copies) this.#copy = this.canvas.getContext("2d", { willReadFrequently: reads })!;
    if (reads && this.#owns) this.#forwardLosses();
    // Hidden until it has the size of the picture, so that nothing visible moves.
    this.canvas.style.cssText = `${IN_THE_CORNER};touch-action:pan-y;visibility:hidden`;
    // The element handles the arrow keys, which an image does not; its label describes the picture.
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-keyshortcuts", "ArrowLeft ArrowRight ArrowUp ArrowDown + -");
    this.canvas.tabIndex = 0;
    this.#root.append(this.canvas, this.labels.element);
    container.append(this.#root);

    this.view = new OrbitCamera(this.canvas, camera);
    this.scene.add(this.#background.object, this.#lights.object);
    if (!bare)
      this.scene.add(
        this.#ground.object,
        this.shade.object,
        this.footprints.object,
        this.path.behind.mesh,
        this.path.ahead.mesh,
      );
    this.#observer = new ResizeObserver(() => {
      this.#measure();
      this.onInvalid?.();
    });
    this.#observer.observe(this.#root);
    onPixelRatio(() => this.onInvalid?.(), this.#life.signal);
    this.#measure();
    this.#screen.add(this);
  }

  restore(): void {
    this.applyQuality();
    this.onInvalid?.();
  }

  /** Whether nothing else draws on its screen: the screen's canvas is shown then, without a copy. */
  set alone(alone: boolean) {
    if (this.#owns || this.#screen.reader || alone === this.#alone) return;
    this.#alone = alone;
    const { canvas } = this.#screen;
    if (alone) {
      canvas.style.cssText = `${IN_THE_CORNER};pointer-events:none`;
      this.#root.prepend(canvas);
      this.onInvalid?.();
    } else {
      canvas.remove();
      this.onInvalid?.();
      // The displayed picture is copied at once, as the next frame may come late.
      this.onIdle?.();
    }
  }

  /** Current level of quality. */
  get quality(): QualityLevel {
    return QUALITY_LEVELS[this.#level]!;
  }

  /** Called twice a second with the frames drawn per second. */
  set onFps(callback: ((fps: number) => void) | undefined) {
    this.#screen.governor.onFps = callback;
  }

  /** Name of the renderer as reported by the browser. */
  get drawnBy(): string {
    return this.#screen.drawnBy;
  }

  /** Size of the picture in CSS pixels. */
  get size(): Readonly<Size> {
    return this.#size;
  }

  /**
   * A copy of the picture; valid only right after it was drawn.
   * @throws Error while the context is lost: the copy would be empty
   */
  copy(): HTMLCanvasElement {
    if (this.#screen.isLost)
      throw new Error("The browser stopped the 3D graphics. Try again later, or reload the page.");
    const copy = document.createElement("canvas");
    Object.assign(copy, this.#pixels);
    this.#copyTo(copy.getContext("2d")!);
    return copy;
  }

  /** Copies the picture in the lower left corner of the screen's canvas. */
  #copyTo(target: CanvasRenderingContext2D): void {
    const { width, height } = this.#pixels;
    const { canvas } = this.#screen;
    target.drawImage(canvas, 0, canvas.height - height, width, height, 0, 0, width, height);
  }

  /** Triangles and draw calls of the last frame, including the shadow pass. */
  get cost(): { triangles: number; calls: number } {
    const { triangles, calls } = this.#screen.renderer.info.render;
    return { triangles, calls };
  }

  /** Sets the theme's colours and light levels; nothing is rebuilt. */
  setTheme(theme: Theme): void {
    this.#theme = theme;
    for (const part of [this.#background, this.#ground, this.footprints, this.path]) part.setTheme(theme);
    this.#lights.setTheme(theme, this.quality.shading);
    this.scene.environmentIntensity = theme.light.environment;
  }

  /** Applies the settings of the current quality. */
  applyQuality(): void {
    this.#level = this.#screen.governor.level;
    const { quality } = this;
    this.#lights.shadowSize = quality.shadowSize;
    if (this.#theme) this.#lights.setTheme(this.#theme, quality.shading);
    this.shade.resolution = quality.shadeSize;
    this.shade.shadowTaps = quality.taps;
    const needsRoom = quality.shading === "physical" || this.#hasOthers;
    this.scene.environment = needsRoom ? this.#screen.environment : null;
    this.onQuality?.(quality);
    void this.compile();
  }

  /**
   * Compiles the materials of an object other than the mannequin before it is added to the scene. Its materials are
   * physical at every level of quality, and need the room.
   */
  async prepare(object: Object3D): Promise<void> {
    this.#hasOthers = true;
    this.scene.environment = this.#screen.environment;
    await this.compileObject(object);
  }

  /** Compiles the materials of an object that does not use the stage's lighting, before it is added to the scene. */
  async compileObject(object: Object3D): Promise<void> {
    await this.#screen.renderer.compileAsync(object, this.view.camera, this.scene);
  }

  /** Compiles everything that will be drawn, one object at a time and without blocking; nothing is drawn meanwhile. */
  async compile(): Promise<void> {
    const turn = ++this.#compilation;
    const current = () => turn === this.#compilation && !this.#screen.isLost;
    this.#compiled = false;
    try {
      await this.#compileScene(current);
      // The first picture is urgent; later ones may wait.
      await this.#screen.queryPrograms(turn === 1 ? TIMEOUT_MS.first : TIMEOUT_MS.later, current);
    } finally {
      if (turn === this.#compilation) {
        this.#compiled = true;
        this.onInvalid?.();
      }
    }
  }

  async #compileScene(current: () => boolean): Promise<void> {
    await otherTasks();
    if (!current()) return;
    const { renderer } = this.#screen;
    const compiling: Promise<unknown>[] = this.#bare ? [] : [this.shade.compile(renderer, this.scene)];
    for (const object of this.scene.children.filter((child) => child !== this.shade.object)) {
      await otherTasks();
      if (!current()) return;
      compiling.push(renderer.compileAsync(object, this.view.camera, this.scene));
    }
    await Promise.all(compiling);
  }

  /** Moves to a view of a subject that faces `heading`, with a glide unless the user prefers reduced motion. */
  setView(view: CameraView, heading: number): void {
    this.view.setView(view, heading, !matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  /** Moves behind a subject that faces `heading`, looking down on the ground ahead of it. */
  setBehind(heading: number): void {
    this.view.orbitAt(
      { azimuth: heading + Math.PI, ...BEHIND },
      !matchMedia("(prefers-reduced-motion: reduce)").matches,
    );
  }

  /** Whether the displayed picture is the finer one of a still scene. */
  get still(): boolean {
    return this.#still;
  }

  /** Width of the overlay at the right of the picture, CSS pixels: the camera centres the subject in the rest. */
  set covered(width: number) {
    this.#covered = width;
    this.#measure();
  }

  /** Size of exported pictures, pixels, regardless of the displayed size; `undefined` for the displayed size. */
  set filmed(size: Readonly<Size> | undefined) {
    this.#filmed = size;
    this.#measure();
  }

  /** Number of columns of the picture; the camera's picture fills one of them. */
  set columns(columns: number) {
    this.#columns = columns;
  }

  /**
   * Begins a frame `dtSecs` after the last call, with more pixels if the picture is `still`. Returns whether it is to
   * be drawn now. The GPU gets few frames at a time, and synchronous queries are postponed until it is idle, unless the
   * picture is needed `atOnce`.
   */
  begin(dtSecs: number, still: boolean, atOnce = false): boolean {
    this.#elapsed += dtSecs;
    if (!this.#compiled || this.#screen.busy) return false;
    const elapsed = this.#elapsed;
    this.#elapsed = 0;
    if (!this.#still && !still) this.#screen.governor.frame(elapsed);
    if (this.#level !== this.#screen.governor.level) {
      this.applyQuality();
      return false;
    }
    const { width, height } = this.#wanted(still);
    this.#screen.expect(width, height);
    if (!this.#screen.fits(width, height) && !this.#screen.mayResize && !atOnce) {
      void this.#screen.whenIdle(() => this.onIdle?.());
      return false;
    }
    this.#still = still;
    if (!still || !this.#screen.reader) this.canvas.toggleAttribute(STILL, still);
    this.#resize();
    this.#screen.renderer.info.reset();
    return true;
  }

  /** Ends a frame after all columns were drawn. */
  end(): void {
    this.#screen.addFrame();
    const { reader } = this.#screen;
    if (reader) this.#readWith(reader);
    else if (this.#copy && !this.#alone) this.#copyTo(this.#copy);
  }

  /** Repeats the events of the screen's canvas, which is not in the document, on the stage's own. */
  #forwardLosses(): void {
    const forward = ({ type }: Event) => this.canvas.dispatchEvent(new Event(type));
    for (const type of ["webglcontextlost", "webglcontextrestored"])
      this.#screen.canvas.addEventListener(type, forward, { signal: this.#life.signal });
  }

  /** Shows the frame that was just drawn, once it was read back. */
  #readWith(reader: FrameReader): void {
    const { width, height } = this.#pixels;
    const still = this.#still;
    void reader.read({ width, height }, (pixels) => {
      const { canvas } = this;
      if (canvas.width !== width || canvas.height !== height || !this.#image) {
        Object.assign(canvas, { width, height });
        this.#image = new ImageData(width, height);
      }
      const { data } = this.#image;
      const row = 4 * width;
      for (let y = 0; y < height; y++) data.set(pixels.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
      this.#copy!.putImageData(this.#image, 0, 0);
      canvas.toggleAttribute(STILL, still && this.#still);
    });
  }

  /** Draws the scene into a column, with the light on `subject`. */
  render(subject: Vector3, column = 0): void {
    this.#lights.follow(subject, this.view.azimuth);
    if (!this.#bare) {
      // The shade map's pass also draws the light's shadow map, which the picture's pass reuses.
      this.#screen.renderer.shadowMap.needsUpdate = true;
      this.shade.render(this.#screen.renderer, this.scene, middle.lerpVectors(subject, this.view.target, 0.5));
      this.#ground.follow(this.view.target);
    }
    const width = this.#pixels.width / this.#columns;
    this.#screen.renderer.setViewport(column * width, 0, width, this.#pixels.height);
    this.#screen.renderer.setScissor(column * width, 0, width, this.#pixels.height);
    this.#screen.renderer.render(this.scene, this.view.camera);
  }

  /** Position of a point of the world (metres) in the picture, CSS pixels from its top left. */
  project(point: Vector3): { x: number; y: number } {
    const p = projected.copy(point).project(this.view.camera);
    return { x: ((p.x + 1) / 2) * this.#size.width, y: ((1 - p.y) / 2) * this.#size.height };
  }

  /** The point on the ground under a point of the picture, CSS pixels from its top left; `undefined` above the horizon. */
  groundAt(x: number, y: number): { x: number; z: number } | undefined {
    const { width, height } = this.#size;
    pointer.set((2 * x) / width - 1, 1 - (2 * y) / height);
    raycaster.setFromCamera(pointer, this.view.camera);
    const hit = raycaster.ray.intersectPlane(GROUND, projected);
    return hit ? { x: hit.x, z: hit.z } : undefined;
  }

  dispose(): void {
    // Work postponed until the screen is idle may run after this.
    this.onQuality = this.onInvalid = this.onIdle = undefined;
    this.#screen.remove(this);
    this.#observer.disconnect();
    this.#life.abort();
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
    this.scene.environment = null;
    if (this.#owns) this.#screen.dispose();
    else if (this.#alone) this.#screen.canvas.remove();
    this.#root.remove();
  }

  /** Size that the picture should have in pixels of the canvas; empty while it is hidden. */
  #wanted(still: boolean): Size {
    if (this.#filmed) return this.#filmed;
    const { clientWidth, clientHeight } = this.#root;
    const ratio = pixelRatio(this.quality, clientWidth * clientHeight, devicePixelRatio, still);
    return { width: Math.floor(clientWidth * ratio), height: Math.floor(clientHeight * ratio) };
  }

  /** Fits the camera to the element's size. */
  #measure(): void {
    const { clientWidth: width, clientHeight: height } = this.#root;
    if (!width || !height) return;
    this.#size = { width, height };
    if (this.#filmed) this.view.resize(this.#filmed.width / this.#columns, this.#filmed.height);
    else this.view.resize(width / this.#columns, height, this.#covered);
  }

  /** Fits the picture to the element's size. */
  #resize(): void {
    this.#measure();
    const { width, height } = this.#size;
    const pixels = this.#wanted(this.#still);
    if (pixels.width * pixels.height === 0) return;
    const { canvas } = this.#screen;
    // Every assignment to the canvas's size allocates new memory, so each is assigned at most once.
    if (!this.#screen.fits(pixels.width, pixels.height)) this.#screen.resize(pixels.width, pixels.height);
    this.#pixels = pixels;
    if (!this.#copies || this.#alone) {
      canvas.style.width = `${width}px`;
      canvas.style.height = `${height}px`;
      canvas.style.objectFit = this.#filmed ? "contain" : "";
      // Scaled by a transform: the browser would count another size as a layout shift, although nothing moves.
      canvas.style.transform = `scale(${canvas.width / pixels.width}, ${canvas.height / pixels.height})`;
    }
    if (this.#copy) this.#fitCopy(width, height, pixels);
    this.canvas.style.removeProperty("visibility");
    this.#screen.renderer.setScissorTest(true);
  }

  /** Fits the copy's canvas. While the screen's own canvas is shown, it stays empty and only receives pointers and keys. */
  #fitCopy(width: number, height: number, pixels: Size): void {
    const { canvas } = this;
    const wanted = this.#alone ? { width: 1, height: 1 } : pixels;
    // A picture that is read back brings its own size, as the one before it stays visible until then.
    if (!this.#screen.reader && canvas.width !== wanted.width) canvas.width = wanted.width;
    if (!this.#screen.reader && canvas.height !== wanted.height) canvas.height = wanted.height;
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    canvas.style.objectFit = this.#filmed ? "contain" : "";
  }
}

/** Style of a canvas whose lower left part is visible. */
const IN_THE_CORNER = "display:block;position:absolute;left:0;bottom:0;transform-origin:0 100%";
/** The view from behind: radians above the ground, metres away. */
const BEHIND = { elevation: 0.3, distance: 6.4 };
const GROUND = new Plane(new Vector3(0, 1, 0));
const raycaster = new Raycaster();
const pointer = new Vector2();
const projected = new Vector3();
const middle = new Vector3();
