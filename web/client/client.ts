/** One database, one input and one session of an {@link EngineClient}, as the page needs them. */
import type { BuiltInSet } from "../engine/built_in";
import { cancelled, disposed, StrutError } from "../engine/errors";
import type { ClientAtlas } from "./atlas/client_atlas";
import type { ClientDrive } from "./drive/drive_client";
import type { DriveControl, DriveFrame, DriveInfo, Driven, Root } from "./drive/protocol";
import { EngineClient, type EngineClientSetup, type EngineRestart } from "./engine_client";
import type { ClientDatabase, ClientMotion, ClientSession } from "./handles";
import type { LiveStream } from "./live/live_stream";
import type { LiveSetup } from "./live/protocol";
import { optionsKnownTo } from "./options";
import {
  type Analysis,
  type CallOptions,
  type CurveSubject,
  type DatabaseClip,
  type DatabaseInfo,
  type DatabaseSource,
  DEFAULT_OPTIONS,
  type Examples,
  type FrameRange,
  type InputInfo,
  type InputSource,
  type LiveFrame,
  type Performed,
  type RecordedMotion,
  type Restarted,
  type SearchFigures,
  type ShownFrame,
  type StyledClip,
  type StylizeOptions,
} from "./protocol";
import { abortable, type WorkerPort } from "./rpc";
import { Transition } from "./transition";

/**
 * Starts a worker and waits until its engine is loaded.
 * @throws StrutError if the engine cannot be loaded
 */
export async function createStrutClient(setup?: EngineClientSetup): Promise<StrutClient> {
  const start = (preload?: BuiltInSet) => new EngineClient({ ...setup, ...(preload && { preload }) });
  const engine = start();
  try {
    await engine.ready();
  } catch (thrown) {
    engine.dispose();
    throw thrown;
  }
  return new StrutClient(engine, start);
}

/**
 * Starts a worker that takes calls at once and answers them when its engine is loaded. Calls reject if their part
 * cannot be loaded.
 * @param preload the set of built-in motions that is opened first; for `first`, an engine is loaded that only plays
 * such sets, and another replaces it when more is needed
 * @param workers how the workers of both are started; tests replace it
 */
export function startStrutClient(
  preload: BuiltInSet,
  { spawn, spawnStart = spawnStartWorker }: Spawners = {},
): StrutClient {
  const start = (set?: BuiltInSet) => new EngineClient({ ...(spawn && { spawn }), ...(set && { preload: set }) });
  if (preload !== "first") return new StrutClient(start(preload), start);
  return new StrutClient(new EngineClient({ spawn: spawnStart, preload }), start, false);
}

/** Functions that start workers. */
interface Spawners {
  spawn?: () => WorkerPort;
  spawnStart?: () => WorkerPort;
}

function spawnStartWorker(): WorkerPort {
  return new Worker(new URL("./start_worker.ts", import.meta.url), { type: "module", name: "strut start" });
}

type BuiltInInput = Extract<InputSource, { kind: "built-in" }>;

/** The open database and input. */
interface Opened {
  database: ClientDatabase;
  /** The input and its session. */
  playing: { motion: ClientMotion; session: ClientSession } | undefined;
}

/**
 * A client with one database, one input and one session, as the page needs it; `engine_client.ts` has any number of
 * each. Opening a database or an input replaces the previous one only if it succeeds. An open input is retargeted to a
 * new database. Rejections are `StrutError`s with `code`, `message` (a sentence for the user) and `hint`. After a fault
 * the client starts a new worker, reopens the same database and input with the same options at the same position, and
 * then calls `onRestart`.
 */
export class StrutClient {
  onRestart: ((restarted: Restarted) => void) | undefined;
  private opened: Opened | undefined;
  /** The driven character on the open database. */
  private steered: ClientDrive | undefined;
  /** The live performer styled on the open database. */
  private performer: LiveStream | undefined;
  private options: StylizeOptions = DEFAULT_OPTIONS;
  private loop: [loop: boolean, range: FrameRange | undefined] = [true, undefined];
  /** Open requests run one after another, so that the last one wins. */
  private opening: Promise<unknown> = Promise.resolve();
  /** The last displayed frame of the open input. */
  private shown: ShownFrame | undefined;
  /** The fade from what was displayed before to the present playback, and the output time at which it began. */
  private fade: { transition: Transition; beginSecs: number } | undefined;
  /** The last requested frame. */
  private showing: Promise<unknown> = Promise.resolve();
  /** The exchange in progress. */
  private exchanging: Promise<unknown> | undefined;
  private disposed = false;

  /**
   * @param start starts a full engine, which loads a set of built-in motions at once
   * @param whole whether `engine` is a full engine; otherwise it only plays the first set of motions
   */
  constructor(
    private engine: EngineClient,
    private readonly start: (preload?: BuiltInSet) => EngineClient,
    private whole = true,
  ) {
    this.listenTo(engine);
  }

  openDatabase(source: DatabaseSource, call?: CallOptions): Promise<DatabaseInfo> {
    return this.inTurn(async () => {
      if (!this.whole && !isFirst(source)) return this.openInNewEngine(source, call);
      const database = await this.engine.openDatabase(source, call);
      try {
        const motion = this.opened?.playing?.motion;
        const session = motion && (await this.createSession(database, motion, call?.signal));
        const before = this.opened;
        this.opened = { database, playing: motion && session && { motion, session } };
        this.closeDrive();
        this.closeLive();
        before?.database.dispose();
      } catch (thrown) {
        database.dispose();
        throw thrown;
      }
      return database.info;
    });
  }

  /**
   * Opens a database in a worker of its own while the open one keeps playing, and then replaces it. The input continues
   * from the displayed frame, at its position. Fails as {@link openDatabase} does.
   */
  async exchangeDatabase(source: DatabaseSource, call?: CallOptions): Promise<DatabaseInfo> {
    const exchanging = this.openInNewEngine(source, call, (move) => this.inTurn(move));
    this.exchanging = exchanging;
    try {
      return await exchanging;
    } finally {
      if (this.exchanging === exchanging) this.exchanging = undefined;
    }
  }

  /** Names of the built-in inputs, the default first; those of the open set, if there is one. */
  builtInInputs(): Promise<string[]> {
    const source = this.opened?.database.source;
    return this.engine.builtInMotions(source?.kind === "demo" ? source.set : undefined);
  }

  /** Indices and names of the neutral clips of the open database. */
  async neutralClips(): Promise<{ clip: number; name: string }[]> {
    return this.openedDatabase().database.neutralClips();
  }

  /** A clip of the open database, by its index. */
  async clipOfDatabase(clip: number): Promise<DatabaseClip> {
    return this.openedDatabase().database.clip(clip);
  }

  async openInput(source: InputSource, call?: CallOptions): Promise<InputInfo> {
    if (!this.whole && !isFirst(source)) await this.ensureFullEngine(call);
    return this.inTurn(async () => {
      const { database } = this.openedDatabase();
      const motion = await this.engine.openMotion(source, call);
      try {
        const info = await motion.on(database, call);
        const session = await this.createSession(database, motion, call?.signal);
        const before = this.opened?.playing;
        this.opened = { database, playing: { motion, session } };
        this.shown = undefined;
        this.fade = undefined;
        this.closeDrive();
        this.closeLive();
        before?.motion.dispose();
        return info;
      } catch (thrown) {
        motion.dispose();
        throw thrown;
      }
    });
  }

  /** Takes effect with the next frame. */
  async configure(options: StylizeOptions): Promise<void> {
    const before = this.options;
    this.options = options;
    try {
      this.configureLive();
      await Promise.all([this.opened?.playing?.session.configure(options), this.steered?.configure(options)]);
    } catch (thrown) {
      if (this.options === options) this.options = before;
      throw thrown;
    }
  }

  /** Whether playback loops; `range` is the part of the input that is played. */
  async setLoop(loop: boolean, range?: FrameRange): Promise<void> {
    this.loop = [loop, range];
    await this.opened?.playing?.session.setLoop(loop, range);
  }

  /** Advances the output clock by `dtSecs` (≥ 0; 0 repeats the current content in the current style). */
  step(dtSecs: number): Promise<LiveFrame> {
    // While paused, the frame is shown without a fade.
    if (!(dtSecs > 0)) this.fade = undefined;
    return this.show((session) => session.step(dtSecs));
  }

  /** Jumps to an input frame. The engine is warmed up on the frames before it. */
  seek(inputFrame: number): Promise<LiveFrame> {
    this.fade = undefined;
    return this.show((session) => session.seek(inputFrame));
  }

  /** Continues from a frame that something else displayed: from the same position and at the same time. */
  continueFrom(shown: ShownFrame): Promise<LiveFrame> {
    return this.show(async (session) => {
      const frame = await session.continueFrom(shown);
      this.fade = { transition: Transition.between(shown.pose, frame.pose), beginSecs: frame.timeOut };
      return frame;
    });
  }

  /** The whole input with the current options. */
  async analyse(call?: CallOptions): Promise<Analysis> {
    await this.ensureFullEngine(call);
    return this.openedInput().session.analyse(call);
  }

  /**
   * Opens an atlas: the input on the database as a picture of all distances, with at most `columns` columns. The caller
   * disposes of it.
   */
  async openAtlas(columns: number, call?: CallOptions): Promise<ClientAtlas> {
    await this.ensureFullEngine(call);
    const { database } = this.openedDatabase();
    return this.engine.openAtlas(database, this.openedInput().motion, columns, call);
  }

  /**
   * Records the prediction of the open input, or of a range of it, in every style of the database, within the memory
   * limit: for crowds that perform it (`crowd/`). The styles of the options do not matter.
   * @throws StrutError `bad-input` if it is shorter than half a second
   */
  async record(options: StylizeOptions, range: FrameRange | undefined, call?: CallOptions): Promise<RecordedMotion> {
    await this.ensureFullEngine(call);
    const { motion, session } = this.openedInput();
    const { database } = session;
    return this.engine.openBy((to) => to.call("recordMotion", [motion.id, database.id, options, range], call));
  }

  /** The examples behind the result of {@link analyse}. */
  async examples(subject: CurveSubject, call?: CallOptions): Promise<Examples> {
    await this.ensureFullEngine(call);
    return this.openedInput().session.examples(subject, call);
  }

  /** The whole input with other options, as fast as the engine can. Playback is not affected. */
  async style(options: StylizeOptions, call?: CallOptions): Promise<StyledClip> {
    await this.ensureFullEngine(call);
    const { motion, session } = this.openedInput();
    return motion.stylize(session.database, options, false, call);
  }

  /**
   * The input as performed in a style, if it is known: a built-in input, and a package that has the counterparts
   * (`compare/`).
   */
  async counterpart(style: string): Promise<Performed | undefined> {
    return this.openedInput().motion.counterpart(style);
  }

  /**
   * Compares the search by kd-trees with the exact one over the whole input, for `neighbours` neighbours in every class
   * among `candidates` candidates of its kd-tree. `undefined` from a package without kd-trees (`compare/` has them).
   */
  async compareSearch(neighbours: number, candidates: number, call?: CallOptions): Promise<SearchFigures | undefined> {
    const { motion, session } = this.openedInput();
    return motion.compareSearch(session.database, neighbours, candidates, call);
  }

  /** The styled input as BVH text, on the input's own skeleton. */
  async exportBvh(call?: CallOptions): Promise<string> {
    await this.ensureFullEngine(call);
    return this.openedInput().session.exportBvh(call);
  }

  /**
   * Starts driving a character with the neutral clips of the database, from a position on, until another input or
   * database is opened or {@link closeDrive} is called. The input stays open.
   * @throws StrutError if the clips for driving cannot be loaded; nothing changes then
   */
  async openDrive(root: Root, call?: CallOptions): Promise<DriveInfo> {
    await this.ensureFullEngine(call);
    const { ClientDrive } = await import("./drive/drive_client");
    return this.inTurn(async () => {
      const { database } = this.openedDatabase();
      const { options: asked } = this;
      const options = optionsKnownTo(database.info, asked);
      const drive = await this.engine.openBy((to) => ClientDrive.open(to, database, options, root, call));
      this.closeDrive();
      this.closeLive();
      this.steered = drive;
      // Calls made from now on are answered after these.
      if (this.options !== asked) drive.configure(optionsKnownTo(database.info, this.options)).catch(() => {});
      return drive.info;
    });
  }

  /** Advances the driven character by `dtSecs`; 0 repeats the current instant in the current style. */
  async drive(dtSecs: number, control: DriveControl): Promise<DriveFrame> {
    return this.openedDrive().drive(dtSecs, control);
  }

  /** The recording of what was driven. */
  async driven(): Promise<Driven> {
    return this.openedDrive().driven();
  }

  /** Restarts at a position, and discards the recording. */
  async resetDrive(root: Root): Promise<void> {
    return this.openedDrive().reset(root);
  }

  closeDrive(): void {
    this.steered?.dispose();
    this.steered = undefined;
  }

  /**
   * Starts styling a live performer on the open database, until another input or database is opened, a character is
   * driven, or {@link closeLive} is called. The input stays open. The caller pushes the poses that arrive,
   * and advances the stream.
   */
  async openLive(setup: Omit<LiveSetup, "options">, call?: CallOptions): Promise<LiveStream> {
    await this.ensureFullEngine(call);
    const { LiveStream } = await import("./live/live_stream");
    return this.inTurn(async () => {
      const { database } = this.openedDatabase();
      const options = optionsKnownTo(database.info, this.options);
      const live = await LiveStream.open(this.engine, database, { ...setup, options });
      this.closeDrive();
      this.closeLive();
      this.performer = live;
      this.configureLive();
      return live;
    });
  }

  closeLive(): void {
    this.performer?.dispose();
    this.performer = undefined;
  }

  dispose(): void {
    this.closeLive();
    this.disposed = true;
    this.engine.dispose();
  }

  /**
   * Resolves when the engine is a full one. If no full engine is being loaded, or it fails to load, another is started
   * and continues with the open database and input.
   * @throws StrutError as for {@link exchangeDatabase}
   */
  private async ensureFullEngine(call: CallOptions | undefined): Promise<void> {
    if (this.whole) return;
    // Others may wait for the same engine: it is loaded even if this caller cancels.
    await abortable(call?.signal, async () => {
      await this.exchanging?.catch(() => {});
      // A database requested earlier may have brought a full engine.
      await this.inTurn(async () => {
        if (!this.whole) await this.openInNewEngine(this.openedDatabase().database.source, undefined);
      });
    });
  }

  /** Opens a database in another engine, to which `turn` moves what is open. */
  private async openInNewEngine(
    source: DatabaseSource,
    call: CallOptions | undefined,
    turn = (move: () => Promise<void>) => move(),
  ): Promise<DatabaseInfo> {
    const engine = this.start(source.kind === "demo" ? (source.set ?? "built-in") : undefined);
    try {
      const database = await engine.openDatabase(source, call);
      await turn(() => this.migrateTo(engine, database, call));
      return database.info;
    } catch (thrown) {
      engine.dispose();
      throw thrown;
    }
  }

  /** Continues playback in another engine, which has a database of its own open. */
  private async migrateTo(
    engine: EngineClient,
    database: ClientDatabase,
    call: CallOptions | undefined,
  ): Promise<void> {
    const played = this.opened?.playing?.motion.source;
    let playing: Opened["playing"];
    if (played) {
      // Another database may have another set.
      const { source: from } = database;
      const source = played.kind === "built-in" && from.kind === "demo" ? inSet(played, from.set) : played;
      const motion = await engine.openMotion(source, call);
      playing = { motion, session: await this.createSession(database, motion, call?.signal, engine) };
      // The first frames of a session are slow; during playback they would be dropped.
      await playing.session.seek(this.shown?.inputFrame ?? 0);
    }
    // The frame in progress is displayed first, and playback continues from it.
    await this.showing.catch(() => {});
    if (this.disposed) throw disposed("client");
    if (call?.signal?.aborted) throw cancelled(call.signal.reason);
    const before = this.engine;
    before.onRestart = undefined;
    this.listenTo(engine);
    this.engine = engine;
    this.whole = true;
    this.opened = { database, playing };
    if (playing) {
      // Calls made on the previous session meanwhile.
      playing.session.configure(optionsKnownTo(database.info, this.options)).catch(() => {});
      playing.session.setLoop(...this.loop).catch(() => {});
      if (this.shown) this.continueFrom(this.shown).catch(() => {});
    }
    void before.retire();
  }

  private listenTo(engine: EngineClient): void {
    engine.onRestart = (restart) => this.restarted(restart);
  }

  private configureLive(): void {
    const { performer } = this;
    performer?.configure(optionsKnownTo(performer.database.info, this.options));
  }

  private async show(ask: (session: ClientSession) => Promise<LiveFrame>): Promise<LiveFrame> {
    const { session } = this.openedInput();
    const showing = ask(session);
    this.showing = showing;
    const frame = await showing;
    if (session !== this.opened?.playing?.session) return frame;
    this.shown = frame;
    const { fade } = this;
    const goesOn = fade && !frame.looped && fade.transition.apply(frame.pose, frame.timeOut - fade.beginSecs);
    if (!goesOn) this.fade = undefined;
    return frame;
  }

  /** A session with the current options, without the styles that only another database had. */
  private async createSession(
    database: ClientDatabase,
    motion: ClientMotion,
    signal: AbortSignal | undefined,
    engine = this.engine,
  ): Promise<ClientSession> {
    const asked = this.options;
    const options = optionsKnownTo(database.info, asked);
    const session = await engine.createSession(database, motion, options, signal && { signal });
    // Calls made from now on are answered after these.
    if (this.options === asked) this.options = options;
    else session.configure(optionsKnownTo(database.info, this.options)).catch(() => {});
    session.setLoop(...this.loop).catch(() => {});
    return session;
  }

  private restarted({ message, lost }: EngineRestart): void {
    const kinds: ("database" | "input")[] = [];
    if (this.opened?.playing?.session.closed) {
      this.opened.playing.motion.dispose();
      this.opened.playing = undefined;
      kinds.push("input");
    }
    if (this.opened?.database.closed) {
      this.opened = undefined;
      kinds.unshift("database");
    }
    if (this.steered?.closed) this.steered = undefined;
    if (this.performer?.closed) this.closeLive();
    this.onRestart?.({ why: message, lost: kinds, reason: kinds.length > 0 ? lost[0]!.reason : "" });
  }

  private openedDatabase(): Opened {
    if (this.disposed) throw disposed("client");
    if (!this.opened) throw notOpen("database");
    return this.opened;
  }

  private openedDrive(): ClientDrive {
    if (!this.steered) throw notOpen("drive");
    return this.steered;
  }

  private openedInput(): { motion: ClientMotion; session: ClientSession } {
    const { playing } = this.openedDatabase();
    if (!playing) throw notOpen("input");
    return playing;
  }

  private inTurn<T>(open: () => Promise<T>): Promise<T> {
    const turn = this.opening.then(open, open);
    this.opening = turn;
    return turn;
  }
}

/** Whether a database or an input is in the first set of motions. */
function isFirst(source: DatabaseSource | InputSource): boolean {
  return "set" in source && source.set === "first";
}

/** The source of a built-in input in a set. */
function inSet({ kind, name }: BuiltInInput, set: BuiltInSet | undefined): InputSource {
  return { kind, name, ...(set && { set }) };
}

function notOpen(what: string): StrutError {
  return new StrutError({ code: "not-open", message: `No ${what} is open.`, hint: `Open a ${what} first.` });
}
