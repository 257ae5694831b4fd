/** {@link Strut} over one client of the engine. */
import type { EngineClient } from "../client/engine_client";
import { ClientDatabase, type ClientMotion, type ClientSession } from "../client/handles";
import { changedOptions } from "../client/options";
import {
  type Analysis,
  type BuiltInSet,
  type CallOptions,
  type DatabaseInfo,
  DEFAULT_OPTIONS,
  type FrameRange,
  type InputSource,
  type LiveFrame,
  type MemoryInfo,
  type MotionFacts,
  StrutError,
  type StyledClip,
  type StylizeOptions,
} from "../client/protocol";
import type { HumanoidAnimation } from "../formats/animation";
import type { ClipOptions, RigNode, ThreeLike } from "../formats/animation_clip";
import { type TraceFrame, traceOf } from "../formats/trace";
import { builtInName, readSource } from "./sources";
import type { Database, LiveStylizer, Motion, Options, Playback, Source, Strut, StyledMotion, Thread } from "./types";

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

  async openDatabase(source: Source, call: CallOptions = {}): Promise<Database> {
    const name = builtInName(source);
    if (name !== undefined) return this.client.openDatabase({ kind: "demo", set: setOf(name) }, call);
    const file = await readSource(source, "database", call.signal);
    return this.client.openDatabase({ kind: "strutdb", name: file.name, file: new Blob([file.bytes]) }, call);
  }

  async openMotion(source: Source, call: CallOptions = {}): Promise<Motion> {
    const name = builtInName(source);
    const opened = name === undefined ? await fileOf(source, call) : await this.#builtIn(name);
    const motion = await this.client.openMotion(opened, call);
    try {
      return new OpenedMotion(motion, opened.name, await motion.read(call));
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

  async createStylizer(database: Database, options?: Options): Promise<LiveStylizer> {
    return this.client.createStylizer(this.#database(database), options);
  }

  async createPlayback(motion: Motion, database: Database, options?: Options): Promise<Playback> {
    const session = await this.client.createSession(this.#database(database), this.#motion(motion), options);
    return new MotionPlayback(session, { ...DEFAULT_OPTIONS, ...options });
  }

  memory(): Promise<MemoryInfo> {
    return this.client.memory();
  }

  dispose(): void {
    this.client.dispose();
  }

  /** A built-in motion by its name in a URL. @throws StrutError `bad-input` if there is none */
  async #builtIn(wanted: string): Promise<InputSource> {
    if (wanted === inUrl(WALK_INPUT)) return { kind: "built-in", name: WALK_INPUT, set: "walk" };
    const names = await this.client.builtInMotions();
    const name = names.find((known) => inUrl(known) === wanted);
    if (name !== undefined) return { kind: "built-in", name, set: "built-in" };
    const message = `There is no motion 'strut:${wanted}'.`;
    const hint = `There are ${names.map((known) => `strut:${inUrl(known)}`).join(", ")}.`;
    throw new StrutError({ code: "bad-input", message, hint });
  }

  /** @throws StrutError `bad-input` if it was opened by another engine */
  #database(database: Database): ClientDatabase {
    if (database instanceof ClientDatabase && this.client.owns(database)) return database;
    throw foreign("database", "openDatabase");
  }

  /** @throws StrutError `bad-input` if it was opened by another engine */
  #motion(motion: Motion): ClientMotion {
    if (motion instanceof OpenedMotion && this.client.owns(motion.handle)) return motion.handle;
    throw foreign("motion", "openMotion");
  }
}

/** A motion, and what its file says. */
class OpenedMotion implements Motion {
  readonly frames: number;
  readonly rateHz: number;
  readonly durationSecs: number;
  readonly note: string;

  constructor(
    readonly handle: ClientMotion,
    readonly name: string,
    { frames, rateHz, durationSecs, note }: MotionFacts,
  ) {
    [this.frames, this.rateHz, this.durationSecs, this.note] = [frames, rateHz, durationSecs, note];
  }

  async poses(database: Database, call?: CallOptions): Promise<Float32Array> {
    if (!(database instanceof ClientDatabase)) throw foreign("database", "openDatabase");
    return (await this.handle.on(database, call)).poses;
  }

  dispose(): void {
    this.handle.dispose();
  }
}

/** A session whose options can be changed one by one. */
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
  readonly rateHz: number;
  readonly poses: Float32Array;
  readonly timeOut: Float32Array;
  readonly planted: Uint8Array;
  readonly classWeights: Float32Array;
  readonly durationOutSecs: number;
  readonly #animation: HumanoidAnimation;
  readonly #classes: DatabaseInfo["classes"];
  readonly #writers: Writers;
  readonly #bvh: string;
  #trace: TraceFrame[] | undefined;

  constructor(name: string, clip: StyledClip, { rateHz, classes, proportions }: DatabaseInfo, writers: Writers) {
    const { poses, timeOut, planted, classWeights, durationOutSecs, bvh } = clip;
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
      const hint = "Give the mannequin of toGLB(), or a rig with the same joints.";
      throw new StrutError({ code: "bad-input", message: thrown.message, hint }, thrown);
    }
  }
}

type Writers = typeof import("./writers");

/** @throws StrutError `bad-input` if there is no such database */
function setOf(name: string): BuiltInSet {
  if (name === "walk" || name === "built-in") return name;
  const message = `There is no database 'strut:${name}'.`;
  throw new StrutError({ code: "bad-input", message, hint: "There are strut:walk and strut:built-in." });
}

/** The one input that the smaller set has, too. */
const WALK_INPUT = "neutral walk";

/** A name as it stands in a URL: `neutral walk, run and walk` is `neutral-walk-run-and-walk`. */
const inUrl = (name: string): string => name.toLowerCase().replace(/[^a-z0-9]+/g, "-");

async function fileOf(source: Source, { signal }: CallOptions): Promise<InputSource> {
  const { name, bytes } = await readSource(source, "motion", signal);
  return { kind: "bvh", name: name || "motion", bytes };
}

function foreign(what: string, opener: string): StrutError {
  const message = `This ${what} was not opened by this engine.`;
  return new StrutError({ code: "bad-input", message, hint: `Use what ${opener} of the same engine gave.` });
}
