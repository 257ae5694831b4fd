/**
 * What is open in the engine: one database, one input, and the analysis of that input in the present style. Opens,
 * replaces and exports; a failure leaves what was open. Independent of the page, which listens to its events.
 */

import type { OpenedAtlas } from "../client/atlas/opened_atlas";
import {
  type DriveControl,
  type DriveFrame,
  type DriveInfo,
  type Driven,
  type Root,
  STILL,
} from "../client/drive/protocol";
import type { FirstSteps } from "../client/first_steps";
import type { PerformerStream } from "../client/live/protocol";
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
  StrutClient,
  StylizeOptions,
} from "../client/protocol";
import { isCancellation, isFault } from "../client/protocol";
import { createWorldPose, headingOf, worldFromLocal } from "../humanoid";
import { DRIVE, InputLibrary } from "./input_library";
import { Playback, type PlaybackEngine, UNSEEN_MS } from "./playback";
import { Prelude } from "./prelude";
import type { Weights } from "./smoothing";

/** An edit has settled when nothing has changed for so long. */
const SETTLE_MS = 150;

/** Events of a session. */
export interface SessionListeners {
  onDatabase: (database: DatabaseInfo) => void;
  onInput: (input: InputInfo) => void;
  /** A character is steered in place of the input that is open; `undefined`: that input is played again, or another one. */
  onDrive: (drive: DriveInfo | undefined) => void;
  /** A performer is styled in place of the input that is open; `undefined`: that input is played again, or another one. */
  onLive: (live: LivePerformer | undefined) => void;
  /** A link names a performer: nothing is connected to unless a person says so. */
  onLiveAsked: (name: string) => void;
  onAnalysis: (analysis: Analysis) => void;
  /** The examples behind the last analysis, as far as the curve shows them. */
  onExamples: (examples: Examples | undefined) => void;
  /** A new frame, of a steered character a `DriveFrame`; `sought` where it does not follow the one before. */
  onFrame: (frame: LiveFrame | DriveFrame, sought: boolean) => void;
  /** A new frame of what is shown until the engine has an input. */
  onPrelude: (shown: ShownFrame) => void;
  /** Before every repaint of the browser; `now` in milliseconds. */
  onTick: (now: number) => void;
  /** Something failed. */
  onError: (error: unknown) => void;
  /** The engine failed too often to go on playing. */
  onStopped: () => void;
  /** The engine crashed and was restarted. */
  onRestart: (restarted: Restarted) => void;
}

/** A performer, and the name of the input that it is. */
export interface LivePerformer {
  readonly name: string;
  readonly stream: PerformerStream;
}

/** How something that may fail or be cancelled ended. */
export type Outcome = "done" | "failed" | "cancelled";

/** What may take long: opening a database or an input, the analysis in the background, or making a file. */
export type SessionTask = "database" | "input" | "analysis" | "styling" | "export";

/** Shows what takes long, and lets it be cancelled. */
export interface SessionProgress {
  /** Runs a task about `subject`, a name; a task of the same kind that is running is cancelled. */
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
  /** Where {@link database} comes from. */
  databaseSource: DatabaseSource | undefined;
  input: InputInfo | undefined;
  /** Name, in the library, of the input that is open. */
  inputName = "";
  /** What is driven with, while a character is steered; {@link input} stays open beside it. */
  drive: DriveInfo | undefined;
  /** While somebody performs; {@link input} stays open beside it. */
  live: LivePerformer | undefined;
  /** The performer that a link named and that nobody was asked about yet. */
  liveAsked: string | undefined;
  /** What people said of skeletons, which counts for files of which nothing is said. */
  remembered: () => RememberedReadings = () => ({});
  /** What is asked of the steered character now. */
  steer: () => DriveControl = () => STILL;
  /** The last analysis of the input that is open; {@link analysed} says whether it is in the present style. */
  analysis: Analysis | undefined;
  /** The examples behind {@link analysis}, as far as the curve shows them. */
  examples: Examples | undefined;
  /** The newest frame of the engine. */
  frame: LiveFrame | DriveFrame | undefined;
  /** What the timeline's curve shows, where examples of it can be shown beside it. */
  #curve: CurveSubject | undefined;
  /** Whether the engine has the clip in the present options. */
  #analysed = false;
  /** Whether a database is about to take the place of the open one. */
  #exchanging = false;
  readonly #client: StrutClient;
  readonly #progress: SessionProgress;
  readonly #listeners = new Set<Partial<SessionListeners>>();
  #settle: ReturnType<typeof setTimeout> | undefined;
  /** What waits until the engine has the present style all the way. */
  #whenSettled: (() => void)[] = [];
  /** Whether the engine's first frame was seen, or failed. */
  #isPlaying = false;
  /** What waits for that. */
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
        // Where nothing is drawn, as in a page out of sight, the others need not wait for it for ever.
        if (!this.frame) setTimeout(() => this.#plays(), UNSEEN_MS);
        this.frame = frame;
        this.#tell("onFrame", frame, sought);
      },
      onTick: (now) => this.#tell("onTick", now),
      onError: (error, stopped) => {
        this.#plays();
        if (stopped) this.#tell("onStopped");
        // What is asked again once the engine has been started again has not failed.
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

  /** Name of what is shown: in the library, {@link DRIVE} while a character is steered, or the performer's. */
  get chosen(): string {
    return this.live?.name ?? (this.drive ? DRIVE : this.inputName);
  }

  /** What was said of how the file that is shown is read. */
  get reading(): FileReading {
    return (!this.endless && this.input?.reading?.said) || {};
  }

  /** Whether what is shown has no time line: a character who is steered, or a performer. */
  get endless(): boolean {
    return this.drive !== undefined || this.live !== undefined;
  }

  /** Tells `listeners` what happens, in the order in which they came, until `signal` aborts. */
  listen(listeners: Partial<SessionListeners>, signal?: AbortSignal): void {
    if (signal?.aborted) return;
    this.#listeners.add(listeners);
    signal?.addEventListener("abort", () => this.#listeners.delete(listeners), { once: true });
  }

  /** Begins to play with a clip of the first input in `styles`, until the engine has that input; it then goes on from there. */
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
        // Where nobody can be steered, something is shown all the same.
        if (name === DRIVE) await this.#open(this.library.first);
        await this.#open(name);
        // What stands still stays where it is.
        if (frame && stands) this.playback.seek(frame.inputFrame);
      }),
    );
  }

  /**
   * Opens a database beside the open one, once that is seen to play, and then puts it in its place: what plays goes on without a
   * jump. Until then nothing is analysed.
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

  /** The frames that were given are drawn. */
  drawn(): void {
    this.playback.drawn();
    if (this.frame && !this.#isPlaying) this.#plays();
  }

  /** Opens an input of the library; `reading` is what is said of its file now. */
  openInput(name: string, reading?: FileReading): Promise<Outcome> {
    return this.#attempt(() => this.#open(name, reading));
  }

  /** Opens the file that is open once more, read as a person says, and goes on at the same frame. */
  readAs(reading: FileReading): Promise<Outcome> {
    return this.#attempt(async () => {
      const { inputName, frame } = this;
      await this.#open(inputName, reading);
      if (frame) this.playback.seek(frame.inputFrame);
    });
  }

  /**
   * Opens a dropped file as the input; the name it goes by, or `undefined` where it cannot be opened. `onRefused` is told why, in
   * place of those who listen for errors.
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

  /** Opens a clip of the open database as the input, as if its file had been dropped; its name, as {@link openFile}. */
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

  /** Has a performer be styled, whose input goes by a name; `undefined` where that failed. */
  async openLive(name: string, delaySecs: number | undefined): Promise<PerformerStream | undefined> {
    let opened: PerformerStream | undefined;
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

  /** Says that a link names a performer. */
  askForLive(name: string): void {
    this.liveAsked = name;
    this.#tell("onLiveAsked", name);
  }

  setLoop(loop: boolean, range: FrameRange | undefined): void {
    void this.#attempt(() => this.#client.setLoop(loop, range));
  }

  /** Whether {@link analysis} is of the present input in the present style. */
  get analysed(): boolean {
    return this.#analysed;
  }

  /** Analyses the input again once nothing has changed for a moment, `delayMs`. */
  analyseSoon(delayMs = SETTLE_MS): void {
    clearTimeout(this.#settle);
    this.#analysed = false;
    this.#progress.cancel("analysis");
    if (!this.#exchanging) this.#settle = setTimeout(() => void this.#attempt(() => this.#analyse()), delayMs);
  }

  /** What the timeline's curve shows; `undefined` where examples of it cannot be compared. */
  set curve(subject: CurveSubject | undefined) {
    if (subject === this.#curve) return;
    this.#curve = subject;
    if (this.#analysed) void this.#attempt(() => this.#showExamples());
  }

  /** The whole input in other options; see `StrutClient.style`. */
  style(options: StylizeOptions, call: CallOptions): Promise<Analysis & { frameMs: number }> {
    return this.#client.style(options, call);
  }

  /** The whole input in the present style, once the engine has it; `undefined` where that failed or was cancelled. */
  styled(): Promise<Analysis | undefined> {
    return this.#make("styling", (options) => this.#client.analyse(options));
  }

  /** The input on the database as a picture of every distance; see `StrutClient.openAtlas`. */
  openAtlas(columns: number, call: CallOptions): Promise<OpenedAtlas> {
    return this.#client.openAtlas(columns, call);
  }

  /** The input in every style, for those who perform it; see `StrutClient.record`. */
  record(options: StylizeOptions, range: FrameRange | undefined, call: CallOptions): Promise<RecordedMotion> {
    return this.#client.record(options, range, call);
  }

  /** The styled input as BVH text; `undefined` where that failed or was cancelled. */
  exportBvh(): Promise<string | undefined> {
    return this.#make("export", (options) => this.#client.exportBvh(options));
  }

  /** What was driven; `undefined` where that failed. */
  async driven(): Promise<Driven | undefined> {
    let driven: Driven | undefined;
    await this.#attempt(async () => {
      driven = await this.#client.driven();
    });
    return driven;
  }

  /** Brings the steered character back to the middle of the ground, and forgets what it did. */
  async resetDrive(): Promise<void> {
    await this.#attempt(() => this.#client.resetDrive([0, 0, 0]));
    this.playback.refresh();
  }

  /** Resolves when the last request is on screen. */
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
    // Those of the built-in one are the built-in motions.
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
    // Unlike an edit, which may go on, it is whole.
    this.analyseSoon(0);
  }

  /** What the engine opens for a name. @throws UnknownInput */
  #sourceOf(name: string, said: FileReading | undefined): InputSource {
    const source = this.library.source(name);
    if (!source) throw new UnknownInput(name);
    if (source.kind === "built-in") return source;
    const { exact, ...file } = source;
    const reading = said ?? source.reading;
    // Poses that a file was written from are not read at all.
    const isRead = reading !== undefined && Object.keys(reading).length > 0;
    return { ...file, ...(exact && !isRead && { exact }), reading, remembered: this.remembered() };
  }

  /** Has a character be steered from where the one on screen is. */
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

  /** What is shown of a performer now; what was shown before, while nobody is there and in a pause. */
  async #perform({ stream }: LivePerformer, dtSecs: number): Promise<LiveFrame> {
    const shown = dtSecs > 0 ? await stream.advance() : undefined;
    if (!shown) return this.frame ?? this.#client.step(0);
    const { pose, inputPose, planted, reads, frame } = shown;
    const timeOut = frame / stream.database.info.rateHz;
    const frameMs = 1000 * stream.stats.stylingSecs;
    return { pose, inputPose, planted, reads, inputFrame: frame, timeOut, frameMs, looped: false, ended: false };
  }

  /** Where the character on screen is. */
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
   * Makes something of the whole input once the engine has the present style. Not before it plays: until then the open database
   * may be a part of the one that is asked for, see {@link exchangeDatabase}.
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

  /** Runs a task and reports its error, to those who listen unless told otherwise; a cancellation is not reported. */
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
