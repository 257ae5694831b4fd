/**
 * What is open in the engine: one database, one input, and the analysis of that input in the present style. Opens,
 * replaces and exports; what fails leaves what was open as it is.
 */
import type {
  Analysis,
  CallOptions,
  CurveSubject,
  DatabaseInfo,
  DatabaseSource,
  Examples,
  FrameRange,
  InputInfo,
  LiveFrame,
  StrutClient,
  StylizeOptions,
} from "../worker/protocol";
import { InputLibrary } from "./library";
import { Playback } from "./playback";
import type { ProgressLine } from "./progress";
import { strings } from "./strings/strings";
import { errorText, isCancellation, isFault } from "./words";

/** An edit has settled when nothing has changed for so long. */
const SETTLE_MS = 150;

export interface SessionListeners {
  onDatabase: (database: DatabaseInfo) => void;
  onInput: (input: InputInfo) => void;
  onAnalysis: (analysis: Analysis) => void;
  /** The examples behind the last analysis, as far as the curve shows them. */
  onExamples: (examples: Examples | undefined) => void;
  /** A new frame; `sought` where it does not follow the one before. */
  onFrame: (frame: LiveFrame, sought: boolean) => void;
  onTick: (now: number) => void;
  /** A sentence about something that failed. */
  onError: (sentence: string) => void;
  /** The engine failed too often to go on. */
  onStopped: () => void;
  onNote: (sentence: string) => void;
}

/** How something that may fail or be cancelled ended. */
export type Outcome = "done" | "failed" | "cancelled";

/** The progress line of each thing that may take long. */
export interface SessionProgress {
  database: ProgressLine;
  input: ProgressLine;
  analysis: ProgressLine;
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
  /** What the timeline's curve shows, where examples of it can be shown beside it. */
  #curve: CurveSubject | undefined;
  /** Whether the engine has the clip in the present options. */
  #analysed = false;
  readonly #client: StrutClient;
  readonly #progress: SessionProgress;
  readonly #listeners: SessionListeners;
  #settle: ReturnType<typeof setTimeout> | undefined;
  /** What waits until the engine has the present style all the way. */
  #whenSettled: (() => void)[] = [];

  constructor(client: StrutClient, progress: SessionProgress, listeners: SessionListeners) {
    this.#client = client;
    this.#progress = progress;
    this.#listeners = listeners;
    this.playback = new Playback(client, {
      onFrame: listeners.onFrame,
      onTick: listeners.onTick,
      onError: (error, stopped) => {
        if (stopped) listeners.onStopped();
        // What is asked again once the engine has been started again has not failed.
        if (stopped || !isFault(error)) listeners.onError(errorText(error));
      },
      onSettled: () => {
        for (const resume of this.#whenSettled.splice(0)) resume();
      },
    });
    client.onRestart = (message) => {
      listeners.onNote(strings.page.engine.restarted(message));
      this.playback.refresh();
      this.analyseSoon();
    };
  }

  /** Opens a database and then the input `inputName` on it. */
  openDatabase(source: DatabaseSource, inputName: string): Promise<Outcome> {
    const label = source.kind === "demo" ? strings.page.engine.preparing : strings.page.engine.reading(source.name);
    return this.#attempt(() =>
      this.playback.hold(async () => {
        const database = await this.#progress.database.run(label, (options) =>
          this.#client.openDatabase(source, options),
        );
        this.library.builtIn = await this.#client.builtInInputs();
        this.database = database;
        this.databaseSource = source;
        this.playback.forgetStyle();
        this.#listeners.onDatabase(database);
        await this.#open(this.library.has(inputName) ? inputName : this.library.first);
      }),
    );
  }

  /** Opens an input of the library. */
  openInput(name: string): Promise<Outcome> {
    return this.#attempt(() => this.#open(name));
  }

  /** Opens a dropped file as the input; the name it goes by, or `undefined` where it cannot be opened. */
  async openFile(fileName: string, bytes: ArrayBuffer): Promise<string | undefined> {
    const name = this.library.add(fileName, bytes);
    const outcome = await this.openInput(name);
    if (outcome === "failed") this.library.remove(name);
    return outcome === "done" ? name : undefined;
  }

  setLoop(loop: boolean, range: FrameRange | undefined): void {
    void this.#attempt(() => this.#client.setLoop(loop, range));
  }

  /** Analyses the input anew once nothing has changed for a moment. */
  analyseSoon(): void {
    clearTimeout(this.#settle);
    this.#analysed = false;
    this.#progress.analysis.cancel();
    this.#settle = setTimeout(() => void this.#attempt(() => this.#analyse()), SETTLE_MS);
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
  async styled(): Promise<Analysis | undefined> {
    let analysis: Analysis | undefined;
    await this.#attempt(async () => {
      await this.#settled();
      analysis = await this.#progress.database.run(strings.page.engine.styling, (options) =>
        this.#client.analyse(options),
      );
    });
    return analysis;
  }

  /** Resolves when what was asked for last is on screen. */
  async shown(): Promise<void> {
    while (!this.playback.upToDate) await new Promise(requestAnimationFrame);
  }

  /** The styled input as BVH text; `undefined` where that failed or was cancelled. */
  async exportBvh(): Promise<string | undefined> {
    let text: string | undefined;
    await this.#attempt(async () => {
      await this.#settled();
      text = await this.#progress.database.run(strings.page.engine.exporting, (options) =>
        this.#client.exportBvh(options),
      );
    });
    return text;
  }

  dispose(): void {
    clearTimeout(this.#settle);
    this.playback.dispose();
    this.#client.dispose();
  }

  async #open(name: string): Promise<void> {
    const source = this.library.source(name);
    if (!source) throw new Error(strings.page.engine.noInput(name));
    const input = await this.#progress.input.run(strings.page.engine.reading(name), (options) =>
      this.#client.openInput(source, options),
    );
    this.input = input;
    this.inputName = name;
    this.playback.refresh();
    this.#listeners.onInput(input);
    this.analyseSoon();
  }

  async #analyse(): Promise<void> {
    const asked = this.#settle;
    await this.#settled();
    const { input } = this;
    if (!input || asked !== this.#settle) return;
    try {
      const analysis = await this.#progress.analysis.run(strings.page.engine.styling, (options) =>
        this.#client.analyse(options),
      );
      if (this.input !== input) return;
      this.#listeners.onAnalysis(analysis);
      this.#analysed = asked === this.#settle;
      if (this.#analysed) await this.#showExamples();
    } catch (error) {
      if (!isFault(error)) throw error;
    }
  }

  async #showExamples(): Promise<void> {
    const { input } = this;
    const subject = this.#curve;
    const examples = subject === undefined ? undefined : await this.#client.examples(subject);
    if (this.input === input && this.#analysed && subject === this.#curve) this.#listeners.onExamples(examples);
  }

  #settled(): Promise<void> {
    return this.playback.settled ? Promise.resolve() : new Promise((resolve) => this.#whenSettled.push(resolve));
  }

  /** Runs a task and says what went wrong; a cancelled one ends without a word. */
  async #attempt(task: () => Promise<void>): Promise<Outcome> {
    try {
      await task();
      return "done";
    } catch (error) {
      if (isCancellation(error)) return "cancelled";
      this.#listeners.onError(errorText(error));
      return "failed";
    }
  }
}
