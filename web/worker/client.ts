/** The page's side: {@link StrutClient} over a worker that is replaced when it fails. */
import { cancelled, disposed, type ErrorParts, StrutError } from "../engine/errors";
import type { Arguments, Call, Method, Reply, Request, Result } from "./messages";
import type {
  Analysis,
  CallOptions,
  CurveSubject,
  DatabaseInfo,
  DatabaseSource,
  Examples,
  FrameRange,
  InputInfo,
  InputSource,
  LiveFrame,
  Performed,
  Progress,
  StrutClient,
  StylizeOptions,
} from "./protocol";

/** As much of a `Worker` as the client needs. */
export interface WorkerPort {
  postMessage(message: Request): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Reply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

/**
 * Starts a worker and waits until its engine is loaded.
 * @param spawn starts the worker; the default is `worker.ts` in a module worker
 * @param silenceMs a worker that says nothing for so long, though it was asked, is replaced
 * @throws StrutError if the engine cannot be loaded
 */
export async function createStrutClient(
  spawn: () => WorkerPort = spawnWorker,
  silenceMs = SILENCE_MS,
): Promise<StrutClient> {
  const client = new WorkerClient(spawn, silenceMs);
  await client.ready;
  return client;
}

/** Starts a worker that takes calls at once and answers them when its engine is loaded; what cannot be loaded rejects them. */
export function startStrutClient(): StrutClient {
  return new WorkerClient(spawnWorker, SILENCE_MS);
}

function spawnWorker(): WorkerPort {
  return new Worker(new URL("./worker.ts", import.meta.url), { type: "module", name: "strut" });
}

interface Pending {
  method: Method;
  resolve(value: Result<Method>): void;
  reject(error: StrutError): void;
  onProgress: ((progress: Progress) => void) | undefined;
}

/** What a new worker must be told to stand where the old one stood. */
interface Memory {
  database: DatabaseSource | undefined;
  input: InputSource | undefined;
  options: StylizeOptions | undefined;
  loop: [loop: boolean, range: FrameRange | undefined] | undefined;
  inputFrame: number;
}

/** A worker that answers nothing for so long is taken to be dead. */
const SILENCE_MS = 20_000;
/** Calls during which a worker may be silent: it reads files in one piece, the rest is done in portions. */
const SILENT: readonly Method[] = ["openDatabase", "openInput", "builtInInputs", "exportBvh"];

class WorkerClient implements StrutClient {
  onRestart: ((message: string) => void) | undefined;
  /** Settles when the first worker's engine is loaded. */
  readonly ready: Promise<void>;
  /** What calls wait for: a worker that replaces another must first stand where that one stood. */
  private restored: Promise<void> = Promise.resolve();

  private worker: WorkerPort | undefined;
  private readonly pending = new Map<number, Pending>();
  private lastId = 0;
  private memory: Memory = emptyMemory();
  /** Whether a frame was styled since the last start: without one a restart would only fail again. */
  private provenSinceStart = true;

  private silence: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly spawn: () => WorkerPort,
    private readonly silenceMs: number,
  ) {
    this.ready = this.start();
    // Calls are rejected with the same error.
    this.ready.catch(() => {});
  }

  // Sources are copied, not transferred: they are needed again after a fault.
  async openDatabase(source: DatabaseSource, options?: CallOptions): Promise<DatabaseInfo> {
    const info = await this.call("openDatabase", [source], options);
    this.memory.database = source;
    return info;
  }

  builtInInputs(): Promise<string[]> {
    return this.call("builtInInputs", []);
  }

  async openInput(source: InputSource, options?: CallOptions): Promise<InputInfo> {
    const info = await this.call("openInput", [source], options);
    this.memory.input = source;
    this.memory.inputFrame = 0;
    return info;
  }

  async configure(options: StylizeOptions): Promise<void> {
    await this.call("configure", [options]);
    this.memory.options = options;
  }

  async setLoop(loop: boolean, range?: FrameRange): Promise<void> {
    await this.call("setLoop", [loop, range]);
    this.memory.loop = [loop, range];
  }

  async step(dtSecs: number): Promise<LiveFrame> {
    return this.remember(await this.call("step", [dtSecs]));
  }

  async seek(inputFrame: number): Promise<LiveFrame> {
    return this.remember(await this.call("seek", [inputFrame]));
  }

  analyse(options?: CallOptions): Promise<Analysis> {
    return this.call("analyse", [], options);
  }

  examples(subject: CurveSubject, options?: CallOptions): Promise<Examples> {
    return this.call("examples", [subject], options);
  }

  style(options: StylizeOptions, call?: CallOptions): Promise<Analysis & { frameMs: number }> {
    return this.call("style", [options], call);
  }

  counterpart(style: string): Promise<Performed | undefined> {
    return this.call("counterpart", [style]);
  }

  exportBvh(options?: CallOptions): Promise<string> {
    return this.call("exportBvh", [], options);
  }

  dispose(): void {
    const error = disposed("client");
    this.refuse(error);
  }

  /** Ends the worker and answers every call with an error. */
  private refuse(error: StrutError): void {
    this.stop(error);
    this.restored = Promise.reject(error);
    this.restored.catch(() => {});
  }

  private remember(frame: LiveFrame): LiveFrame {
    this.memory.inputFrame = frame.inputFrame;
    this.provenSinceStart = true;
    return frame;
  }

  private async call<M extends Method>(method: M, args: Arguments<M>, options: CallOptions = {}): Promise<Result<M>> {
    await this.restored;
    return this.post(method, args, options);
  }

  private post<M extends Method>(method: M, args: Arguments<M>, options: CallOptions = {}): Promise<Result<M>> {
    const { signal, onProgress } = options;
    if (signal?.aborted) return Promise.reject(cancelled());
    const worker = this.worker;
    if (!worker) return Promise.reject(disposed("client"));
    const id = ++this.lastId;
    // The worker decides whether the cancellation came in time, so that both sides agree on what is open.
    const cancel = () => worker.postMessage({ kind: "cancel", id });
    signal?.addEventListener("abort", cancel, { once: true });
    const answer = new Promise<Result<Method>>((resolve, reject) => {
      this.pending.set(id, { method, resolve, reject, onProgress });
      this.watch(worker);
      worker.postMessage({ kind: "call", id, method, args } as Call);
    });
    return answer.finally(() => signal?.removeEventListener("abort", cancel)) as Promise<Result<M>>;
  }

  /** Starts a worker and resolves when its engine is loaded. */
  private start(): Promise<void> {
    return new Promise((resolve, reject) => {
      const worker = this.spawn();
      this.worker = worker;
      let loaded = false;
      const fail = (error: StrutError) => {
        reject(error);
        this.refuse(error);
      };
      worker.onmessage = ({ data }) => {
        if (this.worker !== worker) return;
        if (data.kind === "ready") {
          loaded = true;
          resolve();
        } else if (data.kind === "not-ready") fail(new StrutError(data.error));
        else this.receive(data);
      };
      worker.onerror = (event) => {
        if (this.worker !== worker) return;
        const error = fault(event.message || "its worker could not be started");
        if (loaded) this.restart(error);
        else fail(error);
      };
    });
  }

  /** Waits for an answer: a worker that was ended from outside says nothing. */
  private watch(worker: WorkerPort): void {
    clearTimeout(this.silence);
    this.silence = setTimeout(() => {
      if (this.worker !== worker || this.pending.size === 0) return;
      const reading = [...this.pending.values()].some(({ method }) => SILENT.includes(method));
      if (reading) this.watch(worker);
      else this.restart(fault("its worker does not answer"));
    }, this.silenceMs);
  }

  private receive(reply: Exclude<Reply, { kind: "ready" } | { kind: "not-ready" }>): void {
    const call = this.pending.get(reply.id);
    if (!call) return;
    if (this.worker) this.watch(this.worker);
    if (reply.kind === "progress") {
      call.onProgress?.(reply.progress);
      return;
    }
    this.pending.delete(reply.id);
    if (reply.kind === "result") {
      call.resolve(reply.value);
      return;
    }
    const error = new StrutError(reply.error);
    call.reject(error);
    if (error.code === "fault") this.restart(error);
  }

  /** Ends the worker; all that it had not answered is rejected. */
  private stop(error: StrutError): void {
    clearTimeout(this.silence);
    this.worker?.terminate();
    this.worker = undefined;
    for (const call of this.pending.values()) call.reject(error);
    this.pending.clear();
  }

  private restart(error: StrutError): void {
    this.stop(error);
    const restore = this.provenSinceStart;
    if (!restore) this.memory = emptyMemory();
    this.provenSinceStart = false;
    this.restored = this.start().then(() => this.restore());
    this.restored.then(
      () => this.onRestart?.(restore ? error.message : `${error.message} The database and the input were closed.`),
      () => {},
    );
  }

  private async restore(): Promise<void> {
    const { database, input, options, loop, inputFrame } = this.memory;
    if (database) await this.post("openDatabase", [database]);
    if (options) await this.post("configure", [options]);
    if (loop !== undefined) await this.post("setLoop", loop);
    if (!database || !input) return;
    await this.post("openInput", [input]);
    await this.post("seek", [inputFrame]);
  }
}

function emptyMemory(): Memory {
  return { database: undefined, input: undefined, options: undefined, loop: undefined, inputFrame: 0 };
}

function fault(message: string): StrutError {
  const parts: ErrorParts = {
    code: "fault",
    message: `The engine failed: ${message}.`,
    hint: "This is a bug in Strut; please report it with the file that caused it.",
  };
  return new StrutError(parts);
}
