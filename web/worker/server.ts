/** The worker's side of the wire: one engine with one database, one input and one live session. */
import { loadBuiltIn, type PackedMotions } from "../engine/built_in";
import type { ClipJob } from "../engine/clip_job";
import type { Database } from "../engine/database";
import { Engine } from "../engine/engine";
import { StrutError, toStrutError } from "../engine/errors";
import type { Input } from "../engine/input";
import { DEFAULT_OPTIONS, type Stylizer } from "../engine/stylizer";
import type { Arguments, Call, Method, Reply, Request, Result } from "./messages";
import { type Caller, runToEnd, stage } from "./portions";
import type {
  CurveSubject,
  DatabaseSource,
  FrameRange,
  InputSource,
  Performed,
  StyleWeights,
  StylizeOptions,
} from "./protocol";
import { LiveSession } from "./session";

/** Share of opening that is downloading, as far as people are told. */
const DOWNLOAD_SHARE = 0.8;

/** As much of a worker's global scope as the server needs. */
export interface ServerPort {
  postMessage(message: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

/** How a built-in input looks in a style, where that is known. */
export type Counterparts = (input: string, style: string) => Performed | undefined;

/** Loads the engine and answers the calls that arrive at `port`. */
export async function serve(port: ServerPort, counterparts: Counterparts = () => undefined): Promise<void> {
  const cancelledCalls = new Set<number>();
  const motions = new BuiltInMotions();
  const answering = Engine.load().then((engine) => new Server(engine, motions, counterparts));

  const answer = async (call: Call) => {
    const { id } = call;
    const caller: Caller = {
      isCancelled: () => cancelledCalls.has(id),
      report: (progress) => port.postMessage({ kind: "progress", id, progress }, []),
    };
    try {
      const value = await (await answering).answer(call, caller);
      port.postMessage({ kind: "result", id, value }, buffersOf(value));
    } catch (thrown) {
      port.postMessage({ kind: "failure", id, error: toStrutError(thrown).parts() }, []);
    } finally {
      cancelledCalls.delete(id);
    }
  };
  port.onmessage = ({ data }) => {
    if (data.kind === "cancel") cancelledCalls.add(data.id);
    else void answer(data);
  };
  await answering.then(
    () => port.postMessage({ kind: "ready" }, []),
    (thrown) => port.postMessage({ kind: "not-ready", error: toStrutError(thrown).parts() }, []),
  );
}

/** The buffers of the typed arrays directly in an answer: handlers give arrays that nobody else holds. */
function buffersOf(value: unknown): Transferable[] {
  if (typeof value !== "object" || value === null) return [];
  return Object.values(value).flatMap((field) => (ArrayBuffer.isView(field) ? [field.buffer as ArrayBuffer] : []));
}

/** The built-in motions, which begin to load with the engine. A load that failed is tried again when they are needed. */
class BuiltInMotions {
  private fraction = 0;
  private loading: Promise<PackedMotions> | undefined;
  private readonly waiting = new Set<Caller>();

  constructor() {
    void this.start().catch(() => {});
  }

  async load(caller: Caller): Promise<PackedMotions> {
    this.waiting.add(caller);
    try {
      this.tell(caller);
      return await this.start();
    } finally {
      this.waiting.delete(caller);
    }
  }

  private start(): Promise<PackedMotions> {
    this.loading ??= loadBuiltIn((fraction) => {
      this.fraction = fraction;
      this.waiting.forEach((caller) => void this.tell(caller));
    }).catch((thrown) => {
      this.loading = undefined;
      throw thrown;
    });
    return this.loading;
  }

  private tell(caller: Caller): void {
    if (this.fraction < 1)
      caller.report({ label: "Loading the built-in motions", fraction: this.fraction * DOWNLOAD_SHARE });
  }
}

type Handlers = { [M in Method]: (caller: Caller, ...args: Arguments<M>) => Promise<Result<M>> };

/** All that belongs to one input in one database. */
interface Scene {
  input: Input;
  source: InputSource;
  stylizer: Stylizer;
  session: LiveSession;
  /** The last clip that was styled as a whole, and the options it was styled with. */
  styled: { options: StylizeOptions; job: ClipJob } | undefined;
}

class Server implements Handlers {
  private database: Database | undefined;
  private scene: Scene | undefined;
  private options: StylizeOptions = DEFAULT_OPTIONS;
  private loop = true;
  private range: FrameRange | undefined;
  /** Openings happen one after another, so that the last one asked for is the one that stays. */
  private opening: Promise<unknown> = Promise.resolve();

  constructor(
    private readonly engine: Engine,
    private readonly builtIn: BuiltInMotions,
    private readonly counterparts: Counterparts,
  ) {}

  answer(call: Call, caller: Caller): Promise<Result<Method>> {
    // A call pairs each method with its own arguments; TypeScript does not follow that through the index.
    const handler = this[call.method] as (caller: Caller, ...args: unknown[]) => Promise<Result<Method>>;
    return handler.call(this, caller, ...call.args);
  }

  openDatabase(caller: Caller, source: DatabaseSource): Promise<Result<"openDatabase">> {
    return this.inTurn(async () => {
      await stage(caller, "Opening the database", 0);
      const database = this.engine.openDatabase(
        source.kind === "demo"
          ? { kind: "demo", motions: await this.builtIn.load(caller) }
          : { ...source, bytes: await source.file.arrayBuffer() },
      );
      try {
        await stage(caller, "Opening the database", 0.9);
        // The input stays: its poses move to the new database's humanoid.
        const scene = this.scene && (await this.openScene(database, this.scene.source, caller));
        this.close(this.scene);
        this.database?.dispose();
        this.database = database;
        this.scene = scene;
      } catch (thrown) {
        database.dispose();
        throw thrown;
      }
      return { ...database.info, proportions: database.info.proportions.slice() };
    });
  }

  async builtInInputs(caller: Caller): Promise<string[]> {
    return this.engine.inputsOf(await this.builtIn.load(caller));
  }

  openInput(caller: Caller, source: InputSource): Promise<Result<"openInput">> {
    return this.inTurn(async () => {
      await stage(caller, "Reading the motion", 0);
      const scene = await this.openScene(this.openedDatabase(), source, caller);
      this.close(this.scene);
      this.scene = scene;
      const { info } = scene.input;
      return { ...info, poses: info.poses.slice(), contacts: info.contacts.slice() };
    });
  }

  async configure(_: Caller, options: StylizeOptions): Promise<void> {
    this.scene?.session.configure(options);
    this.options = options;
  }

  async setLoop(_: Caller, loop: boolean, range?: FrameRange): Promise<void> {
    this.loop = loop;
    this.range = range;
    if (this.scene) Object.assign(this.scene.session, { loop, range });
  }

  async step(_: Caller, dtSecs: number): Promise<Result<"step">> {
    return this.openedScene().session.step(dtSecs);
  }

  async seek(_: Caller, inputFrame: number): Promise<Result<"seek">> {
    return this.openedScene().session.seek(inputFrame);
  }

  async analyse(caller: Caller): Promise<Result<"analyse">> {
    return (await this.styledClip(caller)).result();
  }

  async examples(caller: Caller, subject: CurveSubject): Promise<Result<"examples">> {
    return (await this.styledClip(caller)).examples(subject);
  }

  async style(caller: Caller, options: StylizeOptions): Promise<Result<"style">> {
    const { job, frameMs } = await this.runClip(this.openedScene(), options, caller);
    try {
      return { ...job.result(), frameMs };
    } finally {
      job.dispose();
    }
  }

  async counterpart(_: Caller, style: string): Promise<Result<"counterpart">> {
    const { source } = this.openedScene();
    return source.kind === "built-in" ? this.counterparts(source.name, style) : undefined;
  }

  async exportBvh(caller: Caller): Promise<string> {
    return (await this.styledClip(caller)).toBvh();
  }

  /** The open input styled as a whole with the present options. */
  private async styledClip(caller: Caller): Promise<ClipJob> {
    const scene = this.openedScene();
    const { options } = this;
    if (scene.styled?.options === options) return scene.styled.job;
    const { job } = await this.runClip(scene, options, caller);
    scene.styled?.job.dispose();
    scene.styled = { options, job };
    return job;
  }

  /** Styles a scene's input as a whole; `frameMs` is what a frame cost. */
  private async runClip(
    scene: Scene,
    options: StylizeOptions,
    caller: Caller,
  ): Promise<{ job: ClipJob; frameMs: number }> {
    const stylizer = this.engine.createStylizer(this.openedDatabase(), options);
    const job = this.engine.createClipJob(scene.input, stylizer, options.track);
    stylizer.dispose();
    try {
      const isCancelled = () => caller.isCancelled() || this.scene !== scene;
      return { job, frameMs: await runToEnd(job, { ...caller, isCancelled }) };
    } catch (thrown) {
      job.dispose();
      throw thrown;
    }
  }

  private async openScene(database: Database, source: InputSource, caller: Caller): Promise<Scene> {
    const found = source.kind === "bvh" ? source : { ...source, motions: await this.builtIn.load(caller) };
    // A style that only the database before had is no reason to refuse this one.
    this.options = knownTo(database, this.options);
    const input = this.engine.openInput(database, found);
    let stylizer: Stylizer | undefined;
    try {
      stylizer = this.engine.createStylizer(database, this.options);
      const session = new LiveSession(stylizer, input.info, this.options, this.engine.interpolate.bind(this.engine));
      session.loop = this.loop;
      session.range = this.range;
      return { input, source, stylizer, session, styled: undefined };
    } catch (thrown) {
      stylizer?.dispose();
      input.dispose();
      throw thrown;
    }
  }

  private close(scene: Scene | undefined): void {
    scene?.styled?.job.dispose();
    scene?.stylizer.dispose();
    scene?.input.dispose();
  }

  private openedDatabase(): Database {
    if (!this.database) throw notOpen("database");
    return this.database;
  }

  private openedScene(): Scene {
    this.openedDatabase();
    if (!this.scene) throw notOpen("input");
    return this.scene;
  }

  private inTurn<T>(open: () => Promise<T>): Promise<T> {
    const turn = this.opening.then(open, open);
    this.opening = turn;
    return turn;
  }
}

/** Options without the styles and labels that a database lacks; the same object where it has all of them. */
function knownTo(database: Database, options: StylizeOptions): StylizeOptions {
  const { styles, classes } = database.info;
  const { parts, track, action, inputStyle } = options;
  const all = [options.styles, ...Object.values(parts), ...track.map((key) => key.styles)];
  const labelled = classes.some((c) => (!action || action === c.action) && (!inputStyle || inputStyle === c.style));
  if (labelled && all.every((weights) => Object.keys(weights).every((name) => styles.includes(name)))) return options;
  const known = (weights: StyleWeights) =>
    Object.fromEntries(Object.entries(weights).filter(([name]) => styles.includes(name)));
  return {
    ...options,
    ...(labelled ? {} : { action: "", inputStyle: "" }),
    styles: known(options.styles),
    parts: Object.fromEntries(Object.entries(parts).map(([part, weights]) => [part, known(weights)])),
    track: track.map(({ frame, styles }) => ({ frame, styles: known(styles) })),
  };
}

function notOpen(what: string): StrutError {
  return new StrutError({ code: "not-open", message: `No ${what} is open.`, hint: `Open a ${what} first.` });
}
