/**
 * The objects open in the engine: one database, one input, and the analysis of that input in the current style. Opens,
 * replaces and exports them. A failure leaves everything open as it was. It is independent of the page, which listens
 * to its events.
 */

import type { ClientAtlas } from "../client/atlas/client_atlas";
import type { StrutClient } from "../client/client";
import {
  type DriveControl,
  type DriveFrame,
  type DriveInfo,
  type Driven,
  type Root,
  STILL,
} from "../client/drive/protocol";
import type { FirstSteps } from "../client/first_steps";
import type { LiveStream } from "../client/live/live_stream";
import type {
  Analysis,
  CallOptions,
  CurveSubject,
  DatabaseInfo,
  DatabaseSource,
  ExactPoses,
  Examples,
  FileReading,
  FrameRange,
  InputInfo,
  InputSource,
  LiveFrame,
  RecordedMotion,
  RememberedReadings,
  Restarted,
  ShownFrame,
  StylizeOptions,
} from "../client/protocol";
import { isCancellation, isFault } from "../client/protocol";
import { createWorldPose, headingOf, worldFromLocal } from "../humanoid";
import { DRIVE, InputLibrary } from "./input_library";
import { Playback, type PlaybackEngine, UNSEEN_MS } from "./playback";
import { Prelude } from "./prelude";
import type { Weights } from "./smoothing";

/** An edit has settled when nothing has changed for this time. */
const SETTLE_MS = 150;

/** Events of a session. */
interface SessionListeners {
  onDatabase: (database: DatabaseInfo) => void;
  onInput: (input: InputInfo) => void;
  /** Driving started, in place of the open input; `undefined`: the input, or another one, is played again. */
  onDrive: (drive: DriveInfo | undefined) => void;
  /** A live performance started, in place of the open input; `undefined`: the input, or another one, is played again. */
  onLive: (live: LivePerformer | undefined) => void;
  /** A link names a live performer. Nothing is connected until the user agrees. */
  onLiveAsked: (name: string) => void;
  onAnalysis: (analysis: Analysis) => void;
  /** The examples behind the last analysis, with the values that the curve shows. */
  onExamples: (examples: Examples | undefined) => void;
  /** A new frame, for a driven character a `DriveFrame`; `sought` if it does not follow the previous one. */
  onFrame: (frame: LiveFrame | DriveFrame, sought: boolean) => void;
  /** A new frame of the prelude. */
  onPrelude: (shown: ShownFrame) => void;
  /** Called before every repaint of the browser; `now` in milliseconds. */
  onTick: (now: number) => void;
  /** An operation failed. */
  onError: (error: unknown) => void;
  /** The engine failed too often; playback stopped. */
  onStopped: () => void;
  /** The engine failed and was restarted. */
  onRestart: (restarted: Restarted) => void;
}

/** A live performer, and the name of its input. */
export interface LivePerformer {
  readonly name: string;
  readonly stream: LiveStream;
}

/** Result of an operation that can fail or be cancelled. */
export type Outcome = "done" | "failed" | "cancelled";

/** Long tasks: opening a database or an input, the background analysis, or making a file. */
export type SessionTask = "database" | "input" | "analysis" | "styling" | "export";

/** Shows the progress of long tasks, and lets the user cancel them. */
export interface SessionProgress {
  /** Runs a task about `subject`, a name. A running task of the same kind is cancelled. */
  run<T>(task: SessionTask, subject: string, work: (options: CallOptions) => Promise<T>): Promise<T>;
  cancel(task: SessionTask): void;
}

/** An input was requested that the library does not have. */
export class UnknownInput extends Error {
  constructor(readonly input: string) {
    super(`the library has no input “${input}”`);
  }
}

export class Session {
  readonly library = new InputLibrary();
  readonly playback: Playback;
  database: DatabaseInfo | undefined;
  /** Source of {@link database}. */
  databaseSource: DatabaseSource | undefined;
  input: InputInfo | undefined;
  /** Name of the open input in the library. */
  inputName = "";
  /** Facts of driving, while a character is driven; {@link input} stays open. */
  drive: DriveInfo | undefined;
  /** The live performer, while there is one; {@link input} stays open. */
  live: LivePerformer | undefined;
  /** The performer that a link named, until the user is asked about it. */
  liveAsked: string | undefined;
  /** Returns the user's readings of skeletons, which apply to files without a reading of their own. */
  remembered: () => RememberedReadings = () => ({});
  /** Returns the current steering input. */
  steer: () => DriveControl = () => STILL;
  /** The last analysis of the open input; {@link analysed} tells whether it is in the current style. */
  analysis: Analysis | undefined;
  /** The examples behind {@link analysis}, with the values that the curve shows. */
  examples: Examples | undefined;
  /** The newest frame of the engine. */
  frame: LiveFrame | DriveFrame | undefined;
  /** The quantity that the timeline's curve shows, if examples of it can be shown too. */
  #curve: CurveSubject | undefined;
  /** Whether the engine has the clip with the current options. */
  #analysed = false;
  /** Whether a database is about to replace the open one. */
  #exchanging = false;
  readonly #client: StrutClient;
  readonly #progress: SessionProgress;
  readonly #listeners = new Set<Partial<SessionListeners>>();
  #settle: ReturnType<typeof setTimeout> | undefined;
  /** Callbacks waiting until the engine has eased to the current style. */
  #whenSettled: (() => void)[] = [];
  /** Whether the engine's first frame was displayed, or failed. */
  #isPlaying = false;
  /** Callbacks waiting for that. */
  #whenPlaying: (() => void)[] = [];

  constructor(client: StrutClient, progress: SessionProgress) {
    this.#client = client;
    this.#progress = progress;
    const engine: PlaybackEngine = {
      step: (dtSecs) =>
        this.live
          ? this.#perform(this.live, dtSecs)
          : this.drive
            ? client.drive(dtSecs, this.steer())
            : client.step(dtSecs),
      seek: (frame) =>
        this.live ? this.#perform(this.live, 0) : this.drive ? client.drive(0, STILL) : client.seek(frame),
      configure: (options) => client.configure(options),
    };
    this.playback = new Playback(engine, {
      onFrame: (frame, sought) => {
        // If nothing is drawn, as in a hidden page, the callbacks must not wait forever.
        if (!this.frame) setTimeout(() => this.#plays(), UNSEEN_MS);
        this.frame = frame;
        this.#tell("onFrame", frame, sought);
      },
      onTick: (now) => this.#tell("onTick", now),
      onError: (error, stopped) => {
        this.#plays();
        if (stopped) this.#tell("onStopped");
        // An operation that will be repeated after the engine has restarted has not failed.
        if (stopped || !isFault(error)) this.#tell("onError", error);
      },
      onSettled: () => {
        for (const resume of this.#whenSettled.splice(0)) resume();
      },
    });
    client.onRestart = (restarted) => {
      this.#tell("onRestart", restarted);
      if (restarted.lost.length > 0) {
        this.#tell("onStopped");
        return;
      }
      this.playback.refresh();
      this.analyseSoon();
    };
  }

  /** Name of the displayed input: in the library, {@link DRIVE} while driving, or the live performer's. */
  get chosen(): string {
    return this.live?.name ?? (this.drive ? DRIVE : this.inputName);
  }

  /** The user's reading of the displayed file. */
  get reading(): FileReading {
    return (!this.endless && this.input?.reading?.said) || {};
  }

  /** Whether the displayed motion has no timeline: driving, or a live performer. */
  get endless(): boolean {
    return this.drive !== undefined || this.live !== undefined;
  }

  /** Calls `listeners` on events, in the order in which they were added, until `signal` aborts. */
  listen(listeners: Partial<SessionListeners>, signal?: AbortSignal): void {
    if (signal?.aborted) return;
    this.#listeners.add(listeners);
    signal?.addEventListener("abort", () => this.#listeners.delete(listeners), { once: true });
  }

  /**
   * Starts playback with a clip of the first input in `styles`, until the engine has that input, which continues from
   * there.
   */
  startWith(clip: FirstSteps, styles: Weights): void {
    if (this.input) return;
    this.playback.startWith({
      prelude: new Prelude(clip, styles),
      onFrame: (shown) => this.#tell("onPrelude", shown),
      continueFrom: (shown) => this.#client.continueFrom(shown),
    });
  }

  /** Opens a database and then the input `inputName` on it. */
  openDatabase(source: DatabaseSource, inputName: string): Promise<Outcome> {
    return this.#attempt(() =>
      this.playback.hold(async () => {
        const subject = source.kind === "demo" ? "" : source.name;
        const database = await this.#progress.run("database", subject, (options) =>
          this.#client.openDatabase(source, options),
        );
        this.playback.forgetStyle();
        await this.#takeDatabase(source, database);
        this.#leaveDrive();
        this.#leaveLive();
        const name = this.library.has(inputName) ? inputName : this.library.first;
        const { frame } = this;
        const stands = name === this.inputName && !this.playback.playing;
        // If driving is not possible, the first input is shown.
        if (name === DRIVE) await this.#open(this.library.first);
        await this.#open(name);
        // A paused character stays where it is.
        if (frame && stands) this.playback.seek(frame.inputFrame);
      }),
    );
  }

  /**
   * Opens a database in a second engine, after playback has begun, and then replaces the open one: playback continues
   * without a jump. Nothing is analysed until then.
   */
  async exchangeDatabase(source: DatabaseSource, signal: AbortSignal): Promise<Outcome> {
    this.#exchanging = true;
    this.analyseSoon();
    const outcome = await this.#attempt(async () => {
      await this.#playing();
      await this.#takeDatabase(source, await this.#client.exchangeDatabase(source, { signal }));
    });
    this.#exchanging = false;
    this.analyseSoon();
    return outcome;
  }

  /** Called when the displayed frames are drawn. */
  drawn(): void {
    this.playback.drawn();
    if (this.frame && !this.#isPlaying) this.#plays();
  }

  /** Opens an input of the library; `reading` is the new reading of its file. */
  openInput(name: string, reading?: FileReading): Promise<Outcome> {
    return this.#attempt(() => this.#open(name, reading));
  }

  /** Opens the current file again with a reading specified by the user, and continues at the same frame. */
  readAs(reading: FileReading): Promise<Outcome> {
    return this.#attempt(async () => {
      const { inputName, frame } = this;
      await this.#open(inputName, reading);
      if (frame) this.playback.seek(frame.inputFrame);
    });
  }

  /**
   * Opens a dropped file as the input. Returns its name in the library, or `undefined` if it cannot be opened. The
   * error is passed to `onRefused` instead of the error listeners.
   */
  async openFile(
    fileName: string,
    bytes: ArrayBuffer,
    { exact, reading }: { exact?: ExactPoses | undefined; reading?: FileReading | undefined } = {},
    onRefused?: (error: unknown) => void,
  ): Promise<string | undefined> {
    const name = await this.library.add(fileName, bytes, exact);
    if (reading) this.library.say(name, reading);
    const outcome = await this.#attempt(() => this.#open(name), onRefused);
    if (outcome === "failed") this.library.remove(name);
    return outcome === "done" ? name : undefined;
  }

  /**
   * Opens a clip of the open database as the input, as if its file had been dropped. Returns its name, as {@link
   * openFile} does.
   */
  async openClip(clip: number): Promise<string | undefined> {
    const { database } = this;
    const found = this.library.clips.find((known) => known.clip === clip);
    if (!database || !found) return undefined;
    let name: string | undefined;
    await this.#attempt(async () => {
      const { bvh, poses } = await this.#client.clipOfDatabase(clip);
      const { proportions, rateHz } = database;
      const bytes = new TextEncoder().encode(bvh).buffer;
      name = await this.openFile(found.name, bytes, { exact: { poses, proportions, rateHz } });
    });
    return name;
  }

  /** Starts styling a live performer, whose input has the name `name`; `undefined` if that failed. */
  async openLive(name: string, delaySecs: number | undefined): Promise<LiveStream | undefined> {
    let opened: LiveStream | undefined;
    await this.#attempt(async () => {
      const stream = await this.#progress.run("input", name, (options) =>
        this.#client.openLive({ delaySecs, follows: true }, options),
      );
      this.#leaveDrive();
      this.#leaveLive();
      opened = stream;
      this.live = { name, stream };
      this.playback.refresh();
      this.#progress.cancel("analysis");
      this.#tell("onLive", this.live);
    });
    return opened;
  }

  /** Reports that a link names a live performer. */
  askForLive(name: string): void {
    this.liveAsked = name;
    this.#tell("onLiveAsked", name);
  }

  setLoop(loop: boolean, range: FrameRange | undefined): void {
    void this.#attempt(() => this.#client.setLoop(loop, range));
  }

  /** Whether {@link analysis} is of the current input in the current style. */
  get analysed(): boolean {
    return this.#analysed;
  }

  /** Analyses the input again once nothing has changed for `delayMs`. */
  analyseSoon(delayMs = SETTLE_MS): void {
    clearTimeout(this.#settle);
    this.#analysed = false;
    this.#progress.cancel("analysis");
    if (!this.#exchanging) this.#settle = setTimeout(() => void this.#attempt(() => this.#analyse()), delayMs);
  }

  /** The quantity that the timeline's curve shows; `undefined` if examples of it cannot be compared. */
  set curve(subject: CurveSubject | undefined) {
    if (subject === this.#curve) return;
    this.#curve = subject;
    if (this.#analysed) void this.#attempt(() => this.#showExamples());
  }

  /** The whole input with other options; see `StrutClient.style`. */
  style(options: StylizeOptions, call: CallOptions): Promise<Analysis & { frameMs: number }> {
    return this.#client.style(options, call);
  }

  /** The whole input in the current style, once the engine has it; `undefined` if that failed or was cancelled. */
  styled(): Promise<Analysis | undefined> {
    return this.#make("styling", (options) => this.#client.analyse(options));
  }

  /** The input on the database as a picture of all distances; see `StrutClient.openAtlas`. */
  openAtlas(columns: number, call: CallOptions): Promise<ClientAtlas> {
    return this.#client.openAtlas(columns, call);
  }

  /** The input in every style, for crowds that perform it; see `StrutClient.record`. */
  record(options: StylizeOptions, range: FrameRange | undefined, call: CallOptions): Promise<RecordedMotion> {
    return this.#client.record(options, range, call);
  }

  /** The styled input as BVH text; `undefined` if that failed or was cancelled. */
  exportBvh(): Promise<string | undefined> {
    return this.#make("export", (options) => this.#client.exportBvh(options));
  }

  /** The recording of driving; `undefined` if that failed. */
  async driven(): Promise<Driven | undefined> {
    let driven: Driven | undefined;
    await this.#attempt(async () => {
      driven = await this.#client.driven();
    });
    return driven;
  }

  /** Moves the driven character back to the middle of the ground, and discards its recording. */
  async resetDrive(): Promise<void> {
    await this.#attempt(() => this.#client.resetDrive([0, 0, 0]));
    this.playback.refresh();
  }

  /** Resolves when the last request is displayed. */
  async shown(): Promise<void> {
    while (!this.playback.upToDate) await new Promise(requestAnimationFrame);
  }

  dispose(): void {
    clearTimeout(this.#settle);
    this.#listeners.clear();
    this.playback.dispose();
    this.#client.dispose();
  }

  async #takeDatabase(source: DatabaseSource, database: DatabaseInfo): Promise<void> {
    this.library.builtIn = await this.#client.builtInInputs();
    this.library.builtInSet = source.kind === "demo" ? source.set : undefined;
    // The clips of the built-in database are the built-in motions.
    this.library.clips = source.kind === "demo" ? [] : await this.#client.neutralClips().catch(() => []);
    this.database = database;
    this.databaseSource = source;
    this.#tell("onDatabase", database);
  }

  async #open(name: string, reading?: FileReading): Promise<void> {
    if (name === DRIVE) {
      await this.#openDrive();
      return;
    }
    const source = this.#sourceOf(name, reading);
    const input = await this.#progress.run("input", name, (options) => this.#client.openInput(source, options));
    this.#leaveDrive();
    this.#leaveLive();
    this.input = input;
    this.inputName = name;
    if (input.reading) this.library.say(name, input.reading.said);
    this.analysis = undefined;
    this.examples = undefined;
    this.playback.refresh();
    this.#tell("onInput", input);
    // Unlike an edit, which may continue, this change is complete.
    this.analyseSoon(0);
  }

  /** The source that the engine opens for a name. @throws UnknownInput */
  #sourceOf(name: string, said: FileReading | undefined): InputSource {
    const source = this.library.source(name);
    if (!source) throw new UnknownInput(name);
    if (source.kind === "built-in") return source;
    const { exact, ...file } = source;
    const reading = said ?? source.reading;
    // If the poses behind a file are known, the file is not read.
    const isRead = reading !== undefined && Object.keys(reading).length > 0;
    return { ...file, ...(exact && !isRead && { exact }), reading, remembered: this.remembered() };
  }

  /** Starts driving from the position of the displayed character. */
  async #openDrive(): Promise<void> {
    const from = this.#root();
    this.drive = await this.#progress.run("input", DRIVE, (options) => this.#client.openDrive(from, options));
    this.#leaveLive();
    this.playback.refresh();
    this.#progress.cancel("analysis");
    this.#tell("onDrive", this.drive);
  }

  #leaveDrive(): void {
    if (!this.drive) return;
    this.drive = undefined;
    this.steer = () => STILL;
    this.#tell("onDrive", undefined);
  }

  #leaveLive(): void {
    if (!this.live) return;
    this.live = undefined;
    this.#tell("onLive", undefined);
  }

  /** The current frame of a live performer; the last displayed frame while there is no performer, and while paused. */
  async #perform({ stream }: LivePerformer, dtSecs: number): Promise<LiveFrame> {
    const shown = dtSecs > 0 ? await stream.advance() : undefined;
    if (!shown) return this.frame ?? this.#client.step(0);
    const { pose, inputPose, planted, reads, frame } = shown;
    const timeOut = frame / stream.database.info.rateHz;
    const frameMs = 1000 * stream.stats.stylingSecs;
    return { pose, inputPose, planted, reads, inputFrame: frame, timeOut, frameMs, looped: false, ended: false };
  }

  /** Position and heading of the displayed character. */
  #root(): Root {
    const pose = this.frame?.pose;
    if (!pose || !this.database) return [0, 0, 0];
    const world = createWorldPose();
    worldFromLocal(this.database.proportions, pose, world);
    return [pose[0]!, pose[2]!, headingOf(world, 0)];
  }

  async #analyse(): Promise<void> {
    const asked = this.#settle;
    await this.#playing();
    await this.#settled();
    const { input } = this;
    if (!input || this.endless || asked !== this.#settle) return;
    try {
      const analysis = await this.#progress.run("analysis", "", (options) => this.#client.analyse(options));
      if (this.input !== input) return;
      this.analysis = analysis;
      this.examples = undefined;
      this.#analysed = asked === this.#settle;
      this.#tell("onAnalysis", analysis);
      if (this.#analysed) await this.#showExamples();
    } catch (error) {
      if (!isFault(error)) throw error;
    }
  }

  async #showExamples(): Promise<void> {
    const { input } = this;
    const subject = this.#curve;
    const examples = subject === undefined ? undefined : await this.#client.examples(subject);
    if (this.input !== input || !this.#analysed || subject !== this.#curve) return;
    this.examples = examples;
    this.#tell("onExamples", examples);
  }

  #plays(): void {
    this.#isPlaying = true;
    for (const resume of this.#whenPlaying.splice(0)) resume();
  }

  #playing(): Promise<void> {
    return this.#isPlaying ? Promise.resolve() : new Promise((resolve) => this.#whenPlaying.push(resolve));
  }

  #settled(): Promise<void> {
    return this.playback.settled ? Promise.resolve() : new Promise((resolve) => this.#whenSettled.push(resolve));
  }

  /**
   * Makes a result of the whole input once the engine has the current style, and not before playback has begun: until
   * then the open database may be only a part of the requested one, see {@link exchangeDatabase}.
   */
  async #make<T>(task: SessionTask, work: (options: CallOptions) => Promise<T>): Promise<T | undefined> {
    let made: T | undefined;
    await this.#attempt(async () => {
      await this.#playing();
      await this.#settled();
      made = await this.#progress.run(task, this.inputName, work);
    });
    return made;
  }

  /** Runs a task and reports its error, to the listeners by default; a cancellation is not reported. */
  async #attempt(
    task: () => Promise<void>,
    report: (error: unknown) => void = (error) => this.#tell("onError", error),
  ): Promise<Outcome> {
    try {
      await task();
      return "done";
    } catch (error) {
      if (isCancellation(error)) return "cancelled";
      report(error);
      return "failed";
    }
  }

  #tell<K extends keyof SessionListeners>(event: K, ...what: Parameters<SessionListeners[K]>): void {
    for (const listeners of [...this.#listeners]) {
      const listener = listeners[event] as ((...what: Parameters<SessionListeners[K]>) => void) | undefined;
      listener?.(...what);
    }
  }
}
