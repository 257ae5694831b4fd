/** {@link Strut} over one client of the engine. */
import type { BuildClient } from "../client/build/client";
import type { EngineClient } from "../client/engine_client";
import type { ClientDatabase, ClientMotion, ClientSession } from "../client/handles";
import type { KeyStyleModel } from "../client/models/key_style";
import type { WalkModel } from "../client/models/walk";
import { changedOptions } from "../client/options";
import {
  type Analysis,
  type BuiltInSet,
  type CallOptions,
  type DatabaseInfo,
  type DatabaseSource,
  DEFAULT_OPTIONS,
  type FileRead,
  type FileReading,
  type FrameRange,
  type InputSource,
  type LiveFrame,
  type MemoryInfo,
  type MotionFacts,
  type Note,
  StrutError,
  type StyledClip,
  type StylizeOptions,
} from "../client/protocol";
import { cancelled } from "../engine/errors";
import type { HumanoidAnimation } from "../formats/animation";
import type { ClipOptions, RigNode, ThreeLike } from "../formats/animation_clip";
import { type TraceFrame, traceOf } from "../formats/trace";
import type { Live, LiveOptions } from "../streams/live";
import type { PoseSource } from "../streams/pose_source";
import { addedStyle, buildDatabase, fileOf, isZip, packedFile } from "./builds";
import { builtInName, readSource } from "./sources";
import type {
  Database,
  LiveStylizer,
  Motion,
  MotionOptions,
  Options,
  Playback,
  Source,
  Strut,
  StyledMotion,
  Thread,
} from "./types";

/** Replaced by the version of `package.json` when the package is built. */
declare const STRUT_VERSION: string;

export class StrutEngine implements Strut {
  readonly version = STRUT_VERSION;
  onrestart: ((message: string) => void) | undefined;

  constructor(
    private readonly client: EngineClient,
    readonly thread: Thread,
  ) {
    client.onRestart = ({ message }) => this.onrestart?.(message);
  }

  async openDatabase(source: Source | readonly File[], call: CallOptions = {}): Promise<Database> {
    if (isList(source)) return this.#build("built", source, call);
    const name = builtInName(source);
    if (name !== undefined) return this.#open({ kind: "demo", set: setOf(name) }, call);
    const { name: called, bytes } = await readSource(source, "database", call.signal);
    if (isZip(bytes)) return this.#build(called, [new File([bytes], `${called || "clips"}.zip`)], call);
    return this.#open({ kind: "strutdb", name: called, file: new Blob([bytes]) }, call);
  }

  async addStyle(database: Database, motion: Motion, style: string, call: CallOptions = {}): Promise<Database> {
    const [known, clip] = [this.#database(database), this.#motion(motion)];
    return this.#built(known.info.name, (builds) => addedStyle(builds, known, clip, style, call));
  }

  async openWalk(source: Source | Database, call: CallOptions = {}): Promise<WalkModel> {
    const database = await this.#trainingSet(source, call);
    if (database) return this.client.openWalk({ database }, call);
    const { bytes } = await readSource(source as Source, "walk model", call.signal);
    return this.client.openWalk({ file: new Uint8Array(bytes) }, call);
  }

  async openKeyStyle(
    source: Source | Database,
    { axes = DEFAULT_AXES, ...call }: { axes?: readonly string[] } & CallOptions = {},
  ): Promise<KeyStyleModel> {
    const database = await this.#trainingSet(source, call);
    const order = { clips: [], action: "", axes, components: 0, em: false };
    if (database) return this.client.openKeyStyle({ motions: { database }, order }, call);
    const { bytes } = await readSource(source as Source, "key-style model", call.signal);
    return this.client.openKeyStyle({ file: new Uint8Array(bytes) }, call);
  }

  async openMotion(source: Source, { reading, ...call }: MotionOptions & CallOptions = {}): Promise<Motion> {
    const name = builtInName(source);
    const opened = name === undefined ? await motionFile(source, reading, call) : await this.#builtIn(name);
    const motion = await this.client.openMotion(opened, call);
    try {
      const facts = await motion.read(call);
      return new OpenedMotion(motion, opened.name, facts, (database) => this.#database(database));
    } catch (thrown) {
      motion.dispose();
      throw thrown;
    }
  }

  async stylize(
    motion: Motion,
    database: Database,
    { bvh = true, signal, onProgress, ...options }: Options & CallOptions & { bvh?: boolean } = {},
  ): Promise<StyledMotion> {
    const on = this.#database(database);
    const call = { ...(signal && { signal }), ...(onProgress && { onProgress }) };
    const all = changedOptions(on.info, DEFAULT_OPTIONS, options);
    const styling = this.#motion(motion).stylize(on, all, bvh, call);
    const [clip, writers] = await Promise.all([styling, import("./writers")]);
    return new StyledResult(motion.name, clip, on.info, writers);
  }

  async createStylizer(
    database: Database,
    { signal, ...options }: Options & Pick<CallOptions, "signal"> = {},
  ): Promise<LiveStylizer> {
    return this.client.createStylizer(this.#database(database), options, signal && { signal });
  }

  async live(
    database: Database,
    source: PoseSource,
    { signal, ...options }: LiveOptions & Pick<CallOptions, "signal"> = {},
  ): Promise<Live> {
    const { openLive } = await import("../streams/live");
    return openLive(this.client, this.#database(database), source, options, signal);
  }

  async createPlayback(
    motion: Motion,
    database: Database,
    { signal, ...options }: Options & Pick<CallOptions, "signal"> = {},
  ): Promise<Playback> {
    const [on, played] = [this.#database(database), this.#motion(motion)];
    const session = await this.client.createSession(on, played, options, signal && { signal });
    return new MotionPlayback(session, { ...DEFAULT_OPTIONS, ...options });
  }

  memory(): Promise<MemoryInfo> {
    return this.client.memory();
  }

  dispose(): void {
    this.client.dispose();
  }

  async #open(source: DatabaseSource, call: CallOptions): Promise<Database> {
    return new OpenedDatabase(await this.client.openDatabase(source, call));
  }

  #build(name: string, files: readonly File[], call: CallOptions): Promise<Database> {
    return this.#built(name, (builds) => buildDatabase(builds, files, call));
  }

  /** Makes a database and opens its file. */
  async #built(name: string, make: (builds: BuildClient) => Promise<Blob>): Promise<Database> {
    return this.#open({ kind: "strutdb", name, file: await this.client.build(make) }, {});
  }

  /** The database to train a model on; `undefined` if the source is the file of a model. */
  async #trainingSet(source: Source | Database, { signal }: CallOptions): Promise<Blob | undefined> {
    if (signal?.aborted) throw cancelled(signal.reason);
    if (isOpened(source)) return fileOf(this.#database(source));
    const name = builtInName(source);
    return name === undefined ? undefined : packedFile(setOf(name));
  }

  /** A built-in motion by its name in a URL. @throws StrutError `bad-input` if there is none */
  async #builtIn(wanted: string): Promise<InputSource> {
    if (wanted === inUrl(WALK_INPUT)) return { kind: "built-in", name: WALK_INPUT, set: "walk" };
    const names = await this.client.builtInMotions();
    const name = names.find((known) => inUrl(known) === wanted);
    if (name !== undefined) return { kind: "built-in", name, set: "built-in" };
    const message = `There is no motion 'strut:${wanted}'.`;
    const hint = `Built-in motions: ${names.map((known) => `strut:${inUrl(known)}`).join(", ")}.`;
    throw new StrutError({ code: "bad-input", message, hint });
  }

  /** @throws StrutError `bad-input` if it was opened by another engine */
  #database(database: Database): ClientDatabase {
    if (database instanceof OpenedDatabase && this.client.owns(database.handle)) return database.handle;
    throw foreign("database", "openDatabase");
  }

  /** @throws StrutError `bad-input` if it was opened by another engine */
  #motion(motion: Motion): ClientMotion {
    if (motion instanceof OpenedMotion && this.client.owns(motion.handle)) return motion.handle;
    throw foreign("motion", "openMotion");
  }
}

class OpenedDatabase implements Database {
  constructor(readonly handle: ClientDatabase) {}

  get info(): DatabaseInfo {
    return this.handle.info;
  }

  async toFile(): Promise<Blob> {
    const { source } = this.handle;
    if (source.kind === "strutdb") return source.file;
    const message = "A built-in database cannot be saved as a file.";
    throw new StrutError({
      code: "bad-input",
      message,
      hint: "Write it with 'strut demo-db', or add a style first.",
    });
  }

  dispose(): void {
    this.handle.dispose();
  }
}

/** A motion and the facts of its file; `own` refuses databases of other engines. */
class OpenedMotion implements Motion {
  readonly frames: number;
  readonly rateHz: number;
  readonly durationSecs: number;
  readonly note: string;
  readonly notes: readonly Note[];
  readonly reading: FileRead | undefined;

  constructor(
    readonly handle: ClientMotion,
    readonly name: string,
    { frames, rateHz, durationSecs, note, notes, reading }: MotionFacts,
    private readonly own: (database: Database) => ClientDatabase,
  ) {
    [this.frames, this.rateHz, this.durationSecs] = [frames, rateHz, durationSecs];
    [this.note, this.notes, this.reading] = [note, notes, reading];
  }

  async poses(database: Database, call?: CallOptions): Promise<Float32Array> {
    return (await this.handle.on(this.own(database), call)).poses;
  }

  dispose(): void {
    this.handle.dispose();
  }
}

/** A session whose options can be changed individually. */
class MotionPlayback implements Playback {
  readonly #session: ClientSession;
  #options: StylizeOptions;

  constructor(session: ClientSession, options: StylizeOptions) {
    this.#session = session;
    this.#options = options;
  }

  configure(change: Options): Promise<void> {
    this.#options = changedOptions(this.#session.database.info, this.#options, change);
    return this.#session.configure(this.#options);
  }

  step(dtSecs: number): Promise<LiveFrame> {
    return this.#session.step(dtSecs);
  }

  seek(inputFrame: number): Promise<LiveFrame> {
    return this.#session.seek(inputFrame);
  }

  setLoop(loop: boolean, range?: FrameRange): Promise<void> {
    return this.#session.setLoop(loop, range);
  }

  analyse(call?: CallOptions): Promise<Analysis> {
    return this.#session.analyse(call);
  }

  dispose(): void {
    this.#session.dispose();
  }
}

class StyledResult implements StyledMotion {
  readonly name: string;
  readonly proportions: Float32Array;
  readonly rateHz: number;
  readonly poses: Float32Array;
  readonly timeOut: Float32Array;
  readonly planted: Uint8Array;
  readonly classWeights: Float32Array;
  readonly durationOutSecs: number;
  readonly notes: readonly Note[];
  readonly distanceMetres: number | undefined;
  readonly #animation: HumanoidAnimation;
  readonly #classes: DatabaseInfo["classes"];
  readonly #writers: Writers;
  readonly #bvh: string;
  #trace: TraceFrame[] | undefined;

  constructor(name: string, clip: StyledClip, { rateHz, classes, proportions }: DatabaseInfo, writers: Writers) {
    const { poses, timeOut, planted, classWeights, durationOutSecs, bvh } = clip;
    [this.notes, this.distanceMetres] = [clip.notes, clip.distanceMetres];
    [this.name, this.proportions] = [name, proportions];
    this.#animation = { name, proportions, poses, times: timeOut };
    this.#writers = writers;
    this.rateHz = rateHz;
    [this.poses, this.timeOut, this.planted, this.classWeights] = [poses, timeOut, planted, classWeights];
    this.durationOutSecs = durationOutSecs;
    this.#classes = classes;
    this.#bvh = bvh;
  }

  get trace(): TraceFrame[] {
    this.#trace ??= traceOf({ analysis: this, input: this, classes: this.#classes });
    return this.#trace;
  }

  toBVH(): string {
    if (this.#bvh) return this.#bvh;
    const message = "The motion was styled with bvh: false.";
    throw new StrutError({ code: "bad-input", message, hint: "Style it with bvh: true." });
  }

  toGLB(): Uint8Array<ArrayBuffer> {
    return this.#writers.mannequinGlb(this.#animation);
  }

  toVRMA(): Uint8Array<ArrayBuffer> {
    return this.#writers.vrmAnimation(this.#animation);
  }

  toAnimationClip<Clip, Track>(three: ThreeLike<Clip, Track>, root: RigNode, options?: ClipOptions): Clip {
    try {
      return this.#writers.toAnimationClip(three, root, this.#animation, options);
    } catch (thrown) {
      if (!(thrown instanceof this.#writers.MissingJointError)) throw thrown;
      const hint = "Pass the mannequin of toGLB(), or a rig with the same joints.";
      throw new StrutError({ code: "bad-input", message: thrown.message, hint }, thrown);
    }
  }
}

type Writers = typeof import("./writers");

/** @throws StrutError `bad-input` if there is no such database */
function setOf(name: string): BuiltInSet {
  if (name === "walk" || name === "built-in") return name;
  const message = `There is no database 'strut:${name}'.`;
  throw new StrutError({ code: "bad-input", message, hint: "Use strut:walk or strut:built-in." });
}

/** Default style variables of key-style models: the separation of the feet. */
const DEFAULT_AXES = ["foot_separation"];

const isList = (source: Source | readonly File[]): source is readonly File[] => Array.isArray(source);

const isOpened = (source: Source | Database): source is Database => source instanceof OpenedDatabase;

/** The only input that the smaller set also has. */
const WALK_INPUT = "neutral walk";

/** A name in the form used in a URL: `neutral walk, run and walk` is `neutral-walk-run-and-walk`. */
const inUrl = (name: string): string => name.toLowerCase().replace(/[^a-z0-9]+/g, "-");

async function motionFile(
  source: Source,
  reading: FileReading | undefined,
  { signal }: CallOptions,
): Promise<InputSource> {
  const { name, bytes } = await readSource(source, "motion", signal);
  return { kind: "bvh", name: name || "motion", bytes, reading };
}

function foreign(what: string, opener: string): StrutError {
  const message = `This ${what} was not opened by this engine.`;
  return new StrutError({ code: "bad-input", message, hint: `Use the result of ${opener} of the same engine.` });
}
