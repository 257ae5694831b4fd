/** The loaded figure of a player: a motion in a style, played and drawn. */
import { changedOptions } from "../client/options";
import { DEFAULT_OPTIONS, type LiveFrame, StrutError, type StylizeOptions } from "../client/protocol";
import { engineOptions } from "../link/engine_options";
import type { Database, Playback as EnginePlayback, Motion, Strut } from "../package/types";
import { Playback } from "../player/playback";
import type { Selection } from "../ui/polygon/selection";
import { type Performer, type Screen, type ThemeColours, type ThemeName, Viewer } from "../viewer";
import type { Drawing } from "./schedule";
import type { Settings } from "./settings";

/** Drawing continues for this time after the last change, in which glides and fades end. */
const AFTERGLOW_MS = 1200;

/** The error of a figure that was disposed of before its picture was drawn. */
const CLOSED = { code: "cancelled", message: "The figure was removed from the page.", hint: "" } as const;

export interface FigureListeners {
  onFrame: (frame: LiveFrame) => void;
  /** Called when the end was reached, and the motion does not loop. */
  onEnd: () => void;
  onError: (error: unknown) => void;
  /** Called when the first picture is displayed. */
  onDrawn: () => void;
}

/** The parts of a figure, all owned by others. */
export interface FigureParts {
  strut: Strut;
  database: Database;
  motion: Motion;
  screen: Screen;
  /** The element in which it is drawn. */
  container: HTMLElement;
}

export class Figure implements Drawing {
  readonly viewer: Viewer;
  readonly rateHz: number;
  /** Frames of the motion at the database's rate. */
  readonly frames: number;
  hasFocus = false;
  frame: LiveFrame | undefined;
  readonly #database: Database;
  readonly #engine: EnginePlayback;
  readonly #playback: Playback;
  readonly #listeners: FigureListeners;
  #settings: Settings;
  #drawUntil = 0;
  #seeking: number | undefined;
  #running = false;
  /** Aborted once the first picture is drawn. */
  readonly #undrawn = new AbortController();
  #isDisposed = false;

  /**
   * Opens a figure.
   * @throws StrutError `bad-input` for styles that the database lacks
   */
  static async open(parts: FigureParts, settings: Settings, listeners: FigureListeners): Promise<Figure> {
    const { strut, database, motion } = parts;
    const options = optionsOf(database, settings);
    const playback = await strut.createPlayback(motion, database, options);
    try {
      // A hidden figure does not advance, but must be drawn once.
      const [first] = await Promise.all([playback.seek(settings.frame), playback.setLoop(settings.loop)]);
      return new Figure(parts, playback, settings, listeners, first);
    } catch (thrown) {
      playback.dispose();
      throw thrown;
    }
  }

  private constructor(
    { database, motion, screen, container }: FigureParts,
    engine: EnginePlayback,
    settings: Settings,
    listeners: FigureListeners,
    first: LiveFrame,
  ) {
    const { info } = database;
    [this.#database, this.#engine, this.#settings, this.#listeners] = [database, engine, settings, listeners];
    this.rateHz = info.rateHz;
    this.frames = Math.round(((motion.frames - 1) / motion.rateHz) * info.rateHz) + 1;
    this.viewer = new Viewer(container, { theme: "light", labels: { styled: "", input: "" }, screen });
    this.viewer.setProportions(info.proportions);
    this.viewer.onDraw = () => {
      this.viewer.onDraw = undefined;
      this.#undrawn.abort();
      listeners.onDrawn();
    };
    for (const type of ["pointerdown", "pointermove", "wheel", "keydown"])
      container.addEventListener(type, () => this.invalidate(), { passive: true });
    this.#playback = new Playback(engine, {
      onFrame: (frame, sought) => this.#take(frame, sought),
      onTick: () => undefined,
      onError: (error, stopped) => {
        if (stopped) listeners.onError(error);
      },
      onSettled: () => undefined,
    });
    this.#playback.options = optionsOf(database, settings);
    this.apply(settings);
    this.#take(first, true);
  }

  /** The current options of styling. */
  get options(): StylizeOptions {
    return optionsOf(this.#database, this.#settings);
  }

  /** Whether the motion advances and styles are eased, or it is suspended while not visible. */
  set running(running: boolean) {
    if (running === this.#running) return;
    this.#running = running;
    if (running) this.#playback.start();
    else this.#playback.dispose();
  }

  get playing(): boolean {
    return this.#playback.playing;
  }

  set playing(playing: boolean) {
    // At the end playback restarts.
    if (playing && this.frame?.ended) this.seek(0);
    this.#playback.playing = playing;
  }

  /** Applies changed settings. @throws StrutError `bad-input` for styles that the database lacks */
  apply(settings: Settings): void {
    this.#playback.options = optionsOf(this.#database, settings);
    if (settings.loop !== this.#settings.loop)
      this.#engine.setLoop(settings.loop).catch((error: unknown) => this.#listeners.onError(error));
    this.#settings = settings;
    this.#playback.speed = settings.speed;
    this.viewer.ghost = settings.ghost;
    this.viewer.zooming = settings.zooms ? "focused" : "never";
    if (this.viewer.view !== settings.camera) this.viewer.camera(settings.camera);
    this.invalidate();
  }

  /** Jumps to an input frame. */
  seek(frame: number): void {
    this.#seeking = frame;
    this.#playback.seek(Math.min(Math.max(0, frame), this.frames - 1));
  }

  /** The displayed or requested input frame. */
  get inputFrame(): number {
    return this.#seeking ?? this.frame?.inputFrame ?? 0;
  }

  /** Makes a character perform, or the mannequin (`undefined`). Resolves when it does. */
  async perform(character: Performer | undefined): Promise<void> {
    await this.viewer.setPerformer(character ?? null);
    this.invalidate();
  }

  setTheme(theme: ThemeName, colours: Partial<ThemeColours>): void {
    this.viewer.theme = theme;
    this.viewer.colours = colours;
    this.invalidate();
  }

  /** Requests a redraw. */
  invalidate(): void {
    this.#drawUntil = performance.now() + AFTERGLOW_MS;
  }

  draw(now: number): boolean {
    if (!this.frame || (now > this.#drawUntil && this.viewer.still)) return false;
    return this.viewer.render(now / 1000);
  }

  /** Draws the first picture also while the page is hidden, when the browser runs no animation frames. */
  drawWhileHidden(): void {
    const draw = () => {
      if (document.hidden) void this.#drawNow();
    };
    document.addEventListener("visibilitychange", draw, { signal: this.#undrawn.signal });
    draw();
  }

  /** The current picture, drawn for this call if necessary. @throws StrutError `cancelled` if it is disposed of meanwhile */
  async picture(): Promise<HTMLCanvasElement> {
    if (!(await this.#drawNow())) throw new StrutError(CLOSED);
    return this.viewer.copy();
  }

  /** Draws as soon as possible. Returns whether it did before it was disposed of. */
  async #drawNow(): Promise<boolean> {
    while (!this.#isDisposed) {
      this.viewer.invalidate();
      if (this.viewer.render(performance.now() / 1000)) return true;
      await new Promise((resolve) => setTimeout(resolve, 4));
    }
    return false;
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#undrawn.abort();
    this.#playback.dispose();
    this.#engine.dispose();
    this.viewer.dispose();
  }

  #take(frame: LiveFrame, sought: boolean): void {
    const { viewer } = this;
    this.frame = frame;
    if (sought) this.#seeking = undefined;
    if (frame.looped || sought) viewer.resetTrail();
    viewer.setStyled(frame.pose);
    viewer.setInput(frame.inputPose);
    viewer.setPlanted(frame.planted);
    this.invalidate();
    if (frame.ended && this.#playback.playing) {
      this.#playback.playing = false;
      this.#listeners.onEnd();
    }
    this.#listeners.onFrame(frame);
  }
}

/** The engine's options for some settings. @throws StrutError `bad-input` for styles that the database lacks */
function optionsOf({ info }: Database, { styles, linked }: Settings): StylizeOptions {
  return changedOptions(info, DEFAULT_OPTIONS, engineOptions({ ...linked, styles }, info.neutral));
}

/** The weights of a selection by name. */
export function weightsOf(styles: Selection): Record<string, number> {
  return Object.fromEntries(styles.map(({ name, weight }) => [name, weight]));
}
