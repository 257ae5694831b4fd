/**
 * Handles of the objects that are open in the worker. Disposing of a handle closes its object there, with all objects
 * made from it.
 */
import { disposed, type StrutError } from "../engine/errors";
import type { Styled } from "../engine/types";
import type { Connection, Post, Reopenable } from "./connection";
import type { Arguments, Id, Method, Result } from "./messages";
import { changedOptions } from "./options";
import type {
  Analysis,
  CallOptions,
  CurveSubject,
  DatabaseClip,
  DatabaseInfo,
  DatabaseSource,
  ExactPoses,
  Examples,
  FrameRange,
  InputInfo,
  InputSource,
  LiveFrame,
  MotionFacts,
  OpenMemory,
  Performed,
  SearchFigures,
  ShownFrame,
  StyledClip,
  StyleWeights,
  StylizeOptions,
} from "./protocol";
import { sizeOf } from "./protocol";

// Sizes in WebAssembly's memory, bytes, as measured in `docs/embedding.md`.
/** Per frame of a database. */
const DATABASE_FRAME_BYTES = 620;
/** Per frame of a motion on the body of a database: its pose. */
const POSE_BYTES = 348;
/** Per byte of a BVH file that was read for a database: its text and its joints. */
const BVH_SHARE = 2;
/** Per stream that is styled, with its history. */
const STREAM_BYTES = 70_000;
/** Per frame of a whole motion that was styled. */
const STYLED_FRAME_BYTES = 1225;

/** Owner of an open object in the worker. It survives a fault of the engine; see `EngineClient.onRestart`. */
export abstract class ClientHandle implements Reopenable {
  private reason: StrutError | undefined;

  /**
   * @param uses objects that it was made from
   * @param noun noun for messages
   */
  protected constructor(
    protected readonly connection: Connection,
    readonly id: Id,
    private readonly uses: readonly ClientHandle[],
    private readonly noun: string,
  ) {
    connection.keep(this);
  }

  /** Why it takes no more calls; `undefined` while it is open. */
  get closed(): StrutError | undefined {
    return this.reason ?? this.uses.find((used) => used.closed)?.closed;
  }

  /** Whether it belongs to the worker behind this connection. */
  isOf(connection: Connection): boolean {
    return this.connection === connection;
  }

  dispose(): void {
    if (this.reason) return;
    this.reason = disposed(this.noun);
    this.connection.forget(this);
  }

  lose(reason: StrutError): void {
    this.reason ??= reason;
  }

  /** Its memory. */
  abstract readonly memory: OpenMemory;

  abstract reopen(post: Post): Promise<unknown>;

  protected call<M extends Method>(method: M, args: Arguments<M>, options?: CallOptions): Promise<Result<M>> {
    const { closed } = this;
    return closed ? Promise.reject(closed) : this.connection.call(method, args, options);
  }
}

/** An open database. */
export class ClientDatabase extends ClientHandle {
  constructor(
    connection: Connection,
    id: Id,
    readonly info: DatabaseInfo,
    readonly source: DatabaseSource,
  ) {
    super(connection, id, [], "database");
  }

  get memory(): OpenMemory {
    return { kind: "database", bytes: DATABASE_FRAME_BYTES * this.info.frames };
  }

  reopen(post: Post): Promise<unknown> {
    return post("openDatabase", [this.id, this.source]);
  }

  /** Indices and names of its neutral clips. */
  neutralClips(): Promise<{ clip: number; name: string }[]> {
    return this.call("neutralClips", [this.id]);
  }

  /** A clip, by its index. */
  clip(clip: number): Promise<DatabaseClip> {
    return this.call("clipOfDatabase", [this.id, clip]);
  }
}

/** An open motion, which can be used with any database. */
export class ClientMotion extends ClientHandle {
  /** Databases for which it was read. */
  private readonly databases = new Set<ClientDatabase>();
  /** `undefined` until it is known. */
  private durationSecs: number | undefined;

  constructor(
    connection: Connection,
    id: Id,
    readonly source: InputSource,
    private readonly exact?: ExactPoses,
  ) {
    super(connection, id, [], "motion");
  }

  get memory(): OpenMemory {
    const file = this.source.kind === "bvh" ? sizeOf(this.source.bytes) : 0;
    const open = [...this.databases].filter(({ closed }) => !closed);
    const read = open.map((database) => POSE_BYTES * this.framesOn(database) + BVH_SHARE * file);
    return { kind: "motion", bytes: read.reduce((sum, bytes) => sum + bytes, file) };
  }

  /** Frames at a database's frame rate; 0 until its duration is known. */
  framesOn({ info }: ClientDatabase): number {
    return this.durationSecs === undefined ? 0 : Math.round(this.durationSecs * info.rateHz);
  }

  /** Records that it was read for a database. */
  usedWith(database: ClientDatabase): void {
    for (const known of this.databases) if (known.closed) this.databases.delete(known);
    this.databases.add(database);
  }

  /**
   * Facts of its file.
   * @throws StrutError as for {@link on}
   */
  async read(options?: CallOptions): Promise<MotionFacts> {
    const facts = await this.call("readMotion", [this.id], options);
    this.durationSecs = facts.durationSecs;
    return facts;
  }

  /**
   * The motion on the humanoid of a database and at its frame rate.
   * @throws StrutError `bad-file` if it is not a motion that Strut can read, `bad-input` for a built-in one that does
   * not exist
   */
  async on(database: ClientDatabase, options?: CallOptions): Promise<InputInfo> {
    const exact = this.exactOn(database);
    if (exact) await this.call("takePoses", [this.id, database.id, exact], options);
    const info = await this.call("motionOn", [this.id, database.id], options);
    this.durationSecs = info.durationSecs;
    this.usedWith(database);
    return info;
  }

  /** The motion as performed in a style, if it is known: a built-in one, in a worker with counterparts. */
  counterpart(style: string): Promise<Performed | undefined> {
    return this.call("counterpart", [this.id, style]);
  }

  /** Compares the search for neighbours by kd-trees with the exact one over the whole motion, in a worker that has kd-trees. */
  async compareSearch(
    database: ClientDatabase,
    neighbours: number,
    candidates: number,
    call?: CallOptions,
  ): Promise<SearchFigures | undefined> {
    const figures = await this.call("compareSearch", [this.id, database.id, neighbours, candidates], call);
    this.usedWith(database);
    return figures;
  }

  /** The whole motion in a style; `bvh` also requests the text of a BVH file. */
  async stylize(
    database: ClientDatabase,
    options: StylizeOptions,
    bvh = false,
    call?: CallOptions,
  ): Promise<StyledClip> {
    const styled = await this.call("stylize", [this.id, database.id, options, bvh], call);
    this.usedWith(database);
    return styled;
  }

  /** The poses from which the file was written, if they fit a database unchanged. */
  private exactOn({ info }: ClientDatabase): Float32Array | undefined {
    const { poses, proportions, rateHz } = this.exact ?? {};
    const fits = rateHz === info.rateHz && proportions?.every((value, i) => value === info.proportions[i]);
    return fits ? poses : undefined;
  }

  async reopen(post: Post): Promise<unknown> {
    await post("openMotion", [this.id, this.source]);
    for (const database of this.databases) {
      const exact = !database.closed && database.id < this.id && this.exactOn(database);
      if (exact) await post("takePoses", [this.id, database.id, exact]);
    }
    return undefined;
  }
}

/** A motion playing in a database: an output clock that styles input frames as they are needed. */
export class ClientSession extends ClientHandle {
  private loop = true;
  private range: FrameRange | undefined;
  /** Playback position; `undefined` before the first frame. */
  private inputFrame: number | undefined;
  /** Whether the worker keeps the whole styled motion. */
  private hasStyled = false;

  constructor(
    connection: Connection,
    id: Id,
    readonly database: ClientDatabase,
    readonly motion: ClientMotion,
    private options: StylizeOptions,
  ) {
    super(connection, id, [database, motion], "session");
    motion.usedWith(database);
  }

  get memory(): OpenMemory {
    const styled = this.hasStyled ? STYLED_FRAME_BYTES * this.motion.framesOn(this.database) : 0;
    return { kind: "session", bytes: STREAM_BYTES + styled };
  }

  /** Takes effect with the next frame; a change of the styles fades in. */
  async configure(options: StylizeOptions): Promise<void> {
    await this.call("configure", [this.id, options]);
    this.options = options;
  }

  /** Whether playback loops; `range` is the part of the motion that is played. */
  async setLoop(loop: boolean, range?: FrameRange): Promise<void> {
    await this.call("setLoop", [this.id, loop, range]);
    this.loop = loop;
    this.range = range;
  }

  /** Advances the output clock by `dtSecs` (≥ 0; 0 repeats the current content in the current style). */
  async step(dtSecs: number): Promise<LiveFrame> {
    return this.stand(await this.call("step", [this.id, dtSecs]));
  }

  /** Jumps to an input frame. The engine is warmed up on the frames before it. */
  async seek(inputFrame: number): Promise<LiveFrame> {
    return this.stand(await this.call("seek", [this.id, inputFrame]));
  }

  /** Continues from a frame that something else displayed: from the same position and at the same time. */
  async continueFrom(shown: ShownFrame): Promise<LiveFrame> {
    return this.stand(await this.call("continueFrom", [this.id, shown]));
  }

  /** The whole motion with the current options. */
  analyse(options?: CallOptions): Promise<Analysis> {
    return this.whole(this.call("analyse", [this.id], options));
  }

  /** The examples of the database behind the result of {@link analyse}. */
  examples(subject: CurveSubject, options?: CallOptions): Promise<Examples> {
    return this.whole(this.call("examples", [this.id, subject], options));
  }

  /** The styled motion as BVH text, on its own skeleton. */
  exportBvh(options?: CallOptions): Promise<string> {
    return this.whole(this.call("exportBvh", [this.id], options));
  }

  reopen(post: Post): Promise<unknown> {
    const { options, loop, range, inputFrame } = this;
    const setup = { database: this.database.id, motion: this.motion.id, options, loop, range, inputFrame };
    return post("createSession", [this.id, setup]);
  }

  /** Returns a result made from the whole styled motion, which the worker then keeps. */
  private async whole<T>(making: Promise<T>): Promise<T> {
    const made = await making;
    this.hasStyled = true;
    return made;
  }

  private stand(frame: LiveFrame): LiveFrame {
    this.inputFrame = frame.inputFrame;
    return frame;
  }
}

/** Further changes of {@link ClientStylizer.setStyles}. */
export interface StyleChange {
  /** Styles of the parts of the body that have their own; unchanged if missing. */
  parts?: StylizeOptions["parts"];
  /** Half-life of this change and those after it, 0 for an immediate change. */
  halfLifeSecs?: number;
}

/**
 * Styles poses as they arrive, with no latency. After a fault it restarts with the current options, as after {@link
 * reset}.
 */
export class ClientStylizer extends ClientHandle {
  /** Number of frames by which the output lags behind the input. */
  readonly latencyFrames = 0;
  /** Settles when the worker has the current options. */
  private changing: Promise<unknown> = Promise.resolve();

  constructor(
    connection: Connection,
    id: Id,
    readonly database: ClientDatabase,
    private options: StylizeOptions,
    private halfLifeSecs: number,
  ) {
    super(connection, id, [database], "stylizer");
  }

  get memory(): OpenMemory {
    return { kind: "stylizer", bytes: STREAM_BYTES };
  }

  /**
   * Takes effect with the next {@link push}.
   * @throws StrutError `bad-input` for an unknown style or part, at once
   */
  setStyles(styles: StyleWeights, { parts, halfLifeSecs }: StyleChange = {}): void {
    this.change({ styles, ...(parts && { parts }) }, halfLifeSecs ?? this.halfLifeSecs);
  }

  /**
   * Takes effect with the next {@link push}.
   * @throws StrutError `bad-input` for an option outside its range, at once
   */
  configure(options: Partial<StylizeOptions>): void {
    this.change(options, this.halfLifeSecs);
  }

  /**
   * Styles the next poses, one frame apart at the database's rate, on its humanoid.
   * @param poses a whole number of poses, at most `MAX_PUSH_FRAMES`; copied
   */
  async push(poses: Float32Array): Promise<Styled> {
    const { changing } = this;
    const [styled] = await Promise.all([this.call("push", [this.id, poses]), changing]);
    return styled;
  }

  /** Restarts at the next pose, as after a cut. */
  reset(): void {
    this.follow(this.call("reset", [this.id]));
  }

  reopen(post: Post): Promise<unknown> {
    return post("createStylizer", [this.id, this.database.id, this.options, this.halfLifeSecs]);
  }

  private change(change: Partial<StylizeOptions>, halfLifeSecs: number): void {
    if (this.closed) throw this.closed;
    this.options = changedOptions(this.database.info, this.options, change);
    this.halfLifeSecs = halfLifeSecs;
    this.follow(this.call("restyle", [this.id, this.options, halfLifeSecs]));
  }

  /** A failed change is reported by the next push. */
  private follow(change: Promise<unknown>): void {
    this.changing = change;
    change.catch(() => {});
  }
}
