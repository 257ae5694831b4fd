/**
 * `<strut-player>`: a figure that moves in a style, on any page (`docs/embedding.md`). It loads when it comes near the
 * visible area, plays while it is visible, and shares one engine, one WebGL context and one drawing schedule with the
 * other players of its page.
 */
import type { Licence } from "../character/licence";
import type { Character } from "../character/types";
import { bvhBytes } from "../client/bvh_bytes";
import { type LiveFrame, StrutError, type StyleWeights } from "../client/protocol";
import { initialOf, writeHash } from "../link/hash";
import { linkedFile } from "../link/linked_file";
import { GHOST_MODES, PLAY_FIELDS } from "../link/play";
import type { Database, Motion, Source } from "../package/types";
import { html } from "../ui/dom";
import { prefersReducedMotion } from "../ui/media";
import { allOf, type Selection, vertexOrder } from "../ui/polygon/selection";
import { graphics } from "../viewer";
import { Announcer } from "./announcer";
import {
  ATTRIBUTE_NAMES,
  type AttributeName,
  type PropertyName,
  readAttribute,
  type ValueOf,
  writeProperty,
} from "./attributes";
import { Bar } from "./bar";
import { Cast, type CastSource } from "./cast";
import { ownColours, themeOf } from "./colours";
import { Credit } from "./credit";
import { Deferred } from "./deferred";
import type { FrameDetail, PlayerTarget } from "./events";
import { type FigureListeners, weightsOf } from "./figure";
import { schedule, sharedEngine, site } from "./host";
import { Message } from "./message";
import { closeFigure, type Opened, openFigure } from "./opened";
import { Poster } from "./poster";
import { defineProperties, takeEarlyProperties } from "./properties";
import { addressesOf, completed, settingsOf } from "./settings";
import { sheets } from "./sheets";
import { isShortcut } from "./shortcut";
import { strings } from "./strings";
import { StylesPanel } from "./styles_panel";

/** Distance from the visible area at which it loads, pixels. */
const NEAR_PX = 200;
/** Minimum time between two updates of the clock during playback, milliseconds, since each one causes a repaint. */
const CLOCK_MS = 60;
/** The error of a player that is removed from its page while it loads. */
const TAKEN_AWAY = { code: "cancelled", message: "The player was removed from the page.", hint: "" } as const;

/** Properties that only reflect an attribute. */
type Plain = Exclude<AttributeName, "src" | "db" | "character" | "styles">;
type Properties = { -readonly [K in Plain as PropertyName<K>]: ValueOf<K> };

/** Without a document, as on a server, the class can be imported but not used. */
const ElementBase = (globalThis.HTMLElement ?? class {}) as new () => PlayerTarget & Properties;

/** `<strut-player>`: a character animated in a style, live. */
export class StrutPlayer extends ElementBase {
  static readonly observedAttributes: readonly string[] = ATTRIBUTE_NAMES;

  readonly #player = html("div", { class: "player" });
  readonly #picture = html("div", { class: "picture" });
  readonly #probe = html("span", { class: "probe", "aria-hidden": "true" });
  readonly #poster = new Poster(() => this.#press());
  readonly #message = new Message();
  readonly #credit = new Credit();
  readonly #cast = new Cast((character) => this.#onCast(character));
  readonly #announcer = new Announcer();
  readonly #styles = new StylesPanel((styles) => this.#choose(styles));
  readonly #bar: Bar;
  readonly #observers: IntersectionObserver[] = [];
  #connected = false;
  #opening: AbortController | undefined;
  #opened: Opened | undefined;
  #ready = new Deferred();
  /** What the page has given as objects; URLs are in the attributes. */
  readonly #given: {
    src?: Source | Motion | undefined;
    db?: Source | Database | undefined;
    character?: CastSource | undefined;
  } = {};
  #visible = false;
  #failed = false;
  /** Whether the open figure has been drawn. */
  #drawn = false;
  /** Whether it plays once it is loaded and visible. */
  #plays = false;
  /** Whether an attribute is being written by the element itself. */
  #reflecting = false;
  #clockAt = 0;
  /** Start position after loading, seconds: the previous position, or one that was sought. */
  #startSecs: number | undefined;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = sheets();
    this.#bar = new Bar(
      {
        onPlay: () => this.#toggle(),
        onSeek: (frame) => this.#opened?.figure.seek(frame),
        onGhost: () => this.#nextGhost(),
        onFullscreen: () => this.#toggleFullscreen(),
      },
      site(),
    );
    const stage = html("div", { class: "stage", part: "stage" });
    stage.append(this.#picture, this.#credit.element, this.#poster.element, this.#message.element);
    const instructions = html("p", { class: "visually-hidden", id: "instructions" }, strings.instructions);
    this.#player.append(
      stage,
      this.#styles.element,
      this.#bar.element,
      this.#probe,
      instructions,
      this.#announcer.element,
    );
    root.append(this.#player);
    this.addEventListener("keydown", (event) => this.#onKey(event));
    this.addEventListener("focusin", () => this.#focus(true));
    this.addEventListener("focusout", () => this.#focus(false));
    this.#probe.addEventListener("transitionrun", () => this.#recolour());
  }

  // --- public API ---

  /** Resolves when the character is displayed; rejects if it cannot be loaded. */
  get ready(): Promise<void> {
    return this.#ready.promise;
  }

  /** The displayed time, seconds of the input. */
  get currentTime(): number {
    const { figure } = this.#opened ?? {};
    return figure ? figure.inputFrame / figure.rateHz : (this.#startSecs ?? 0);
  }

  set currentTime(secs: number) {
    this.seek(secs);
  }

  /** Duration of the input, seconds; 0 until it is loaded. */
  get duration(): number {
    const { figure } = this.#opened ?? {};
    return figure ? (figure.frames - 1) / figure.rateHz : 0;
  }

  /** Whether it is paused. */
  get paused(): boolean {
    return !this.#plays;
  }

  /** The open database; `undefined` until it is loaded. */
  get database(): Database | undefined {
    return this.#opened?.database.value;
  }

  /** The motion: a URL, or an argument or a result of `openMotion`. */
  get src(): Source | Motion {
    return this.#given.src ?? addressesOf(this).src;
  }

  set src(value: Source | Motion) {
    this.#give("src", value);
    this.#reopen();
  }

  /** The database: a URL, or an argument or a result of `openDatabase`. */
  get db(): Source | Database {
    return this.#given.db ?? addressesOf(this).db;
  }

  set db(value: Source | Database) {
    this.#give("db", value);
    this.#reopen();
  }

  /** The character: a URL, empty for the mannequin, a file, or a result of `loadCharacter`. */
  get character(): CastSource {
    return this.#given.character ?? readAttribute(this, "character");
  }

  set character(value: CastSource) {
    this.#give("character", value);
    this.#perform();
  }

  /** Asked if the author of a character does not allow everyone to perform it; without it the character is refused. */
  get accept(): ((licence: Licence) => boolean | Promise<boolean>) | undefined {
    return this.#cast.accept;
  }

  set accept(ask: ((licence: Licence) => boolean | Promise<boolean>) | undefined) {
    this.#cast.accept = ask;
  }

  /** The styles and their weights. */
  get styles(): StyleWeights {
    return weightsOf(this.#opened ? this.#styles.selection : settingsOf(this).styles);
  }

  set styles(value: string | StyleWeights) {
    const selection =
      typeof value === "string" ? value : Object.entries(value).map(([name, weight]) => ({ name, weight }));
    writeProperty(this, "styles", selection);
  }

  /** Loads now, wherever it is on the page. */
  load(): Promise<void> {
    if (!this.#opened && !this.#opening) void this.#open();
    return this.ready;
  }

  /** Plays; loads if necessary. */
  play(): void {
    if (this.#plays) return;
    this.#plays = true;
    this.load().catch(() => undefined);
    this.#applyPlaying();
    this.dispatchEvent(new Event("play"));
  }

  /** Pauses; the picture stays. */
  pause(): void {
    if (!this.#plays) return;
    this.#plays = false;
    this.#applyPlaying();
    this.dispatchEvent(new Event("pause"));
  }

  /** Jumps to a time of the input, seconds. */
  seek(secs: number): void {
    const { figure } = this.#opened ?? {};
    if (figure) figure.seek(secs * figure.rateHz);
    else this.#startSecs = secs;
  }

  /** The picture as a file. @throws TypeError if the browser cannot write that type */
  async toBlob(type = "image/png", quality?: number): Promise<Blob> {
    await this.load();
    const picture = await this.#opened!.figure.picture();
    return new Promise((resolve, reject) => {
      const take = (blob: Blob | null) => (blob ? resolve(blob) : reject(new TypeError(`No ${type} can be written.`)));
      picture.toBlob(take, type, quality);
    });
  }

  /** The whole motion in the current styles as a file. @throws StrutError */
  async exportFile(format: "bvh" | "glb" | "vrma"): Promise<Blob> {
    await this.load();
    const { database, motion, figure } = this.#opened!;
    const strut = await sharedEngine().strut();
    const options = { ...figure.options, bvh: format === "bvh" };
    const styled = await strut.stylize(motion.value, database.value, options);
    if (format === "bvh") return new Blob([bvhBytes(styled.toBVH())], { type: "text/plain" });
    const glb = () => this.#cast.character?.toGLB(styled) ?? styled.toGLB();
    return new Blob([format === "glb" ? glb() : styled.toVRMA()], { type: "model/gltf-binary" });
  }

  // --- custom element callbacks ---

  connectedCallback(): void {
    if (this.#connected) return;
    this.#connected = true;
    takeEarlyProperties(this, ["accept", "currentTime"]);
    this.#plays ||= this.autoplay && !prefersReducedMotion();
    this.#showAttributes();
    this.#observe(NEAR_PX, (isNear) => {
      if (isNear && !this.#opened && !this.#opening && !this.#failed) void this.#open();
    });
    this.#observe(0, (isVisible) => {
      this.#visible = isVisible;
      this.#applyPlaying();
      if (isVisible && this.#cast.isFreed) this.#perform();
      this.#cast.isVisible = isVisible;
    });
    if (this.loading === "eager") void this.#open();
  }

  disconnectedCallback(): void {
    // Moving an element removes and inserts it in one task.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.#connected = false;
      for (const observer of this.#observers.splice(0)) observer.disconnect();
      if (this.#opened) this.#startSecs = this.currentTime;
      // A removed player does not become ready; if it is inserted again, there is a new promise.
      if (!this.#ready.isSettled) this.#ready.reject(new StrutError(TAKEN_AWAY));
      this.#ready = new Deferred();
      this.#close();
      this.#failed = false;
      this.#poster.hidden = false;
    });
  }

  attributeChangedCallback(name: AttributeName, before: string | null, now: string | null): void {
    if (before === now || this.#reflecting || !this.#connected) return;
    this.#showAttributes();
    if (name === "src" || name === "db" || name === "character") {
      // A URL replaces an object.
      delete this.#given[name];
      if (name === "character") this.#perform();
      else this.#reopen();
    } else if (name === "theme") this.#recolour();
    else this.#applySettings();
    if (name === "frame") this.#opened?.figure.seek(this.frame);
  }

  // --- opening and closing ---

  /** Keeps a source; its attribute contains it only if it is a URL. */
  #give<K extends "src" | "db" | "character">(name: K, value: StrutPlayer[K]): void {
    const isUrl = typeof value === "string";
    Object.assign(this.#given, { [name]: isUrl ? undefined : value });
    this.#reflecting = true;
    writeProperty(this, name, isUrl ? value : null);
    this.#reflecting = false;
  }

  /** Opens another motion or database, if one is open or requested already. */
  #reopen(): void {
    if (this.#opened || this.#opening || this.#failed) void this.#open();
  }

  async #open(): Promise<void> {
    this.#opening?.abort();
    const opening = new AbortController();
    this.#opening = opening;
    this.#failed = false;
    if (this.#ready.isSettled) this.#ready = new Deferred();
    this.#message.hide();
    try {
      if (graphics() === "none") throw new StrutError({ code: "unsupported", message: strings.noWebGl, hint: "" });
      const opened = await this.#openFigure(opening.signal);
      if (opening.signal.aborted) {
        closeFigure(opened);
        return;
      }
      this.#close(false);
      this.#opened = opened;
      this.#drawn = false;
      this.#takeOpened(opened);
    } catch (thrown) {
      if (opening.signal.aborted) return;
      this.#fail(thrown);
    } finally {
      if (this.#opening === opening) this.#opening = undefined;
    }
  }

  async #openFigure(signal: AbortSignal): Promise<Opened> {
    const settings = settingsOf(this);
    const file = this.#given.src === undefined && !this.hasAttribute("src") ? await linkedFile(this.state) : undefined;
    const motion = file ? new File([file.bytes], `${file.name}.bvh`) : this.src;
    const listeners: FigureListeners = {
      onFrame: (frame) => this.#onFrame(frame),
      onEnd: () => this.pause(),
      onError: (error) => this.#complain(error),
      onDrawn: () => this.#onDrawn(),
    };
    const onProgress = ({ label, fraction }: { label: string; fraction: number }) => {
      if (signal.aborted) return;
      this.#poster.fraction = fraction;
      this.#announcer.say(`${label}…`);
      this.dispatchEvent(new CustomEvent("progress", { detail: { label, fraction } }));
    };
    this.#poster.fraction = 0;
    const reading = file && settings.linked.reading;
    const wanted = { motion, reading, database: this.db, character: this.character, settings };
    return openFigure(wanted, { cast: this.#cast, picture: this.#picture, listeners }, { onProgress });
  }

  #takeOpened({ figure, database, fault }: Opened): void {
    const settings = settingsOf(this);
    this.#styles.selection = completed(settings.styles, database.value.info.neutral);
    this.#bar.setDuration(figure.frames, figure.rateHz);
    if (this.#startSecs !== undefined) figure.seek(this.#startSecs * figure.rateHz);
    this.#startSecs = undefined;
    this.#bar.frame = figure.inputFrame;
    this.#showAttributes();
    this.#recolour();
    this.#showStyles(false);
    schedule.add(figure);
    figure.drawWhileHidden();
    this.#applyPlaying();
    if (fault) this.#complain(fault);
  }

  /** Makes the requested character perform, once a figure is open. */
  #perform(): void {
    if (!this.#opened) return;
    this.#message.hide();
    this.#cast.take(this.character).catch((thrown: unknown) => this.#complain(thrown));
  }

  #onCast(character: Character | undefined): void {
    this.#credit.show(character?.licence);
    this.#opened?.figure.perform(character).catch((thrown: unknown) => this.#complain(thrown));
  }

  #onDrawn(): void {
    this.#drawn = true;
    this.#applyPlaying();
    this.#poster.hidden = true;
    this.#poster.fraction = undefined;
    this.#announcer.say(strings.ready);
    this.#ready.resolve();
    this.dispatchEvent(new Event("ready"));
  }

  #fail(error: unknown): void {
    this.#failed = true;
    this.#poster.fraction = undefined;
    if (error instanceof StrutError && error.code === "unsupported")
      this.#message.showFallback(`${error.message} ${error.hint}`.trimEnd());
    else this.#message.show(error, () => void this.#open());
    this.#ready.reject(error);
    this.dispatchEvent(new CustomEvent("error", { detail: { error } }));
  }

  /** Shows an error; the displayed figure stays. */
  #complain(error: unknown): void {
    this.#message.show(error);
    this.dispatchEvent(new CustomEvent("error", { detail: { error } }));
  }

  #close(abort = true): void {
    if (abort) {
      this.#opening?.abort();
      this.#opening = undefined;
    }
    const opened = this.#opened;
    this.#opened = undefined;
    if (opened) closeFigure(opened);
    if (abort) this.#cast.dispose();
  }

  #observe(margin: number, act: (isInside: boolean) => void): void {
    const take = (entries: IntersectionObserverEntry[]) => act(entries.at(-1)!.isIntersecting);
    const observer = new IntersectionObserver(take, { rootMargin: `${margin}px` });
    observer.observe(this);
    this.#observers.push(observer);
  }

  // --- from the engine ---

  #onFrame({ inputFrame, timeOut, planted, reads }: LiveFrame): void {
    const now = performance.now();
    if (now - this.#clockAt > CLOCK_MS || !this.#plays) {
      this.#clockAt = now;
      this.#bar.frame = inputFrame;
    }
    const detail: FrameDetail = { inputFrame, timeOut, planted, reads };
    this.dispatchEvent(new CustomEvent("frame", { detail }));
  }

  // --- display ---

  #showAttributes(): void {
    const { controls } = this;
    this.#bar.controls = controls;
    this.#bar.ghost = settingsOf(this).ghost;
    this.#poster.picture = this.poster;
    this.#player.classList.toggle("bare", this.#bar.element.hidden !== false);
    this.#styles.element.hidden = !controls.includes("styles") || !this.#opened;
    this.#describe();
  }

  /** Applies changed attributes. */
  #applySettings(): void {
    const { figure, database } = this.#opened ?? {};
    if (!figure || !database) return;
    const settings = settingsOf(this);
    try {
      figure.apply(settings);
    } catch (thrown) {
      this.#complain(thrown);
      return;
    }
    this.#message.hide();
    this.#styles.selection = completed(settings.styles, database.value.info.neutral);
    this.#showStyles(true);
  }

  #applyPlaying(): void {
    const { figure } = this.#opened ?? {};
    this.#bar.playing = this.#plays;
    if (!figure) return;
    figure.playing = this.#plays;
    // It does not start before it is visible.
    figure.running = this.#visible && this.#drawn;
  }

  #recolour(): void {
    this.#opened?.figure.setTheme(themeOf(this.#probe), ownColours(this));
  }

  #showStyles(glide: boolean): void {
    const { database, figure } = this.#opened!;
    this.#styles.show(database.value.info, glide);
    figure.viewer.covered = this.#styles.covered;
    this.#bar.href = this.#address();
    this.#describe();
  }

  /** The URL of the displayed state in the playground; empty if it is not known. */
  #address(): string {
    if (!site()) return "";
    const { linked } = settingsOf(this);
    const state = { ...initialOf(PLAY_FIELDS), ...linked, styles: this.#styles.selection };
    return `${site()}#${writeHash(PLAY_FIELDS, state)}`;
  }

  #describe(): void {
    const { viewer } = this.#opened?.figure ?? {};
    if (!viewer) return;
    viewer.description = this.alt || strings.description(strings.mix(this.#styles.said));
    viewer.describedBy = "instructions";
  }

  // --- from the visitor ---

  #press(): void {
    if (this.#failed) void this.#open();
    this.play();
  }

  #toggle(): void {
    if (this.#plays) this.pause();
    else this.play();
  }

  /** Handles a visitor's choice of styles. */
  #choose(styles: Selection): void {
    if (!this.#opened) return;
    this.#reflect("styles", styles);
    this.#applySettings();
    const detail = { styles: weightsOf(styles) };
    this.dispatchEvent(new CustomEvent("stylechange", { detail, bubbles: true, composed: true }));
  }

  #nextGhost(): void {
    const { ghost } = settingsOf(this);
    const next = GHOST_MODES[(GHOST_MODES.indexOf(ghost) + 1) % GHOST_MODES.length]!;
    this.#reflect("ghost", next);
    this.#applySettings();
    this.#bar.ghost = next;
    this.#announcer.say(strings.ghost[next]);
  }

  #toggleLoop(): void {
    const { loop } = settingsOf(this);
    this.#reflect("once", loop);
    this.#applySettings();
    this.#announcer.say(loop ? strings.loop.off : strings.loop.on);
  }

  #toggleFullscreen(): void {
    if (document.fullscreenElement === this) void document.exitFullscreen();
    else void this.requestFullscreen?.().catch(() => undefined);
  }

  #reflect<K extends AttributeName>(name: K, value: ValueOf<K>): void {
    this.#reflecting = true;
    writeProperty(this, name, value);
    this.#reflecting = false;
  }

  #focus(hasFocus: boolean): void {
    if (this.#opened) this.#opened.figure.hasFocus = hasFocus;
  }

  #onKey(event: KeyboardEvent): void {
    const { figure, database } = this.#opened ?? {};
    if (!figure || !database || !isShortcut(event)) return;
    const { styles, neutral } = database.value.info;
    const keys: Record<string, (() => void) | undefined> = {
      " ": () => this.#toggle(),
      ArrowLeft: () => figure.seek(Math.round(figure.inputFrame) - 1),
      ArrowRight: () => figure.seek(Math.round(figure.inputFrame) + 1),
      Home: () => figure.seek(0),
      End: () => figure.seek(figure.frames - 1),
      l: () => this.#toggleLoop(),
      g: () => this.#nextGhost(),
      f: () => this.#toggleFullscreen(),
    };
    const style = vertexOrder(styles, neutral)[Number(event.key) - 1];
    const act = style
      ? () => this.#choose(allOf(this.#styles.selection, style))
      : (keys[event.key] ?? keys[event.key.toLowerCase()]);
    if (!act) return;
    event.preventDefault();
    act();
  }
}

defineProperties(StrutPlayer.prototype);
