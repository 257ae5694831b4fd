/** One engine for all players of a page, and the objects that they have open in it: the same file is opened once. */
import type { CallOptions } from "../client/protocol";
import type { Database, Motion, MotionOptions, Source, Strut } from "../package/types";
import { type Lease, Lingering } from "../ui/lingering";

/** Time for which an unused object stays open, milliseconds: pages remove elements and insert them again. */
const LINGER_MS = 10_000;

/** Time for which the unused engine is kept, milliseconds. */
const IDLE_MS = 300_000;

type Opened = { dispose(): void };

interface Shared<T> {
  opening: Lingering<Promise<T>>;
  /** Progress listeners: one of every waiting player. */
  waiting: Set<NonNullable<CallOptions["onProgress"]>>;
}

/** Objects of one kind by their URL. */
class SharedSources<T extends Opened> {
  readonly #shared = new Map<string, Shared<T>>();

  constructor(private readonly open: (source: string, call: CallOptions) => Promise<T>) {}

  async lease(source: string, call: CallOptions): Promise<Lease<T>> {
    const shared = this.#shared.get(source) ?? this.#share(source);
    if (call.onProgress) shared.waiting.add(call.onProgress);
    const { value, release } = shared.opening.lease();
    try {
      return { value: await value, release };
    } catch (thrown) {
      // Another one may have been opened meanwhile.
      if (this.#shared.get(source) === shared) this.#shared.delete(source);
      throw thrown;
    } finally {
      if (call.onProgress) shared.waiting.delete(call.onProgress);
    }
  }

  #share(source: string): Shared<T> {
    const waiting: Shared<T>["waiting"] = new Set();
    // Removing one player must not cancel an opening for which others wait.
    const onProgress: CallOptions["onProgress"] = (progress) => {
      for (const tell of waiting) tell(progress);
    };
    const open = () => this.open(source, { onProgress });
    const close = (opening: Promise<T>) => {
      this.#shared.delete(source);
      void opening.then((opened) => opened.dispose());
    };
    const shared = { opening: new Lingering(LINGER_MS, open, close), waiting };
    this.#shared.set(source, shared);
    return shared;
  }
}

export class SharedEngine {
  readonly #load: () => Promise<Strut>;
  #strut: Promise<Strut> | undefined;
  /** After its last player, a page gets the memory and the worker back after a while. */
  readonly #use = new Lingering(
    IDLE_MS,
    () => undefined,
    () => this.#end(),
  );
  readonly #databases = new SharedSources(async (source, call) => (await this.strut()).openDatabase(source, call));
  readonly #motions = new SharedSources(async (source, call) => (await this.strut()).openMotion(source, call));

  constructor(load: () => Promise<Strut>) {
    this.#load = load;
  }

  /** The engine, which is loaded on first use, and again after a failure. */
  strut(): Promise<Strut> {
    this.#strut ??= this.#load().catch((thrown: unknown) => {
      this.#strut = undefined;
      throw thrown;
    });
    return this.#strut;
  }

  /** An open database, opened if necessary. @throws StrutError */
  database(source: Source | Database, call: CallOptions): Promise<Lease<Database>> {
    if (isOpened(source)) return Promise.resolve(given(source));
    return this.#counted(this.#lease(this.#databases, source, async (strut) => strut.openDatabase(source, call), call));
  }

  /** An open motion, opened if necessary. @throws StrutError */
  motion(source: Source | Motion, call: MotionOptions & CallOptions): Promise<Lease<Motion>> {
    if (isOpened(source)) return Promise.resolve(given(source));
    return this.#counted(this.#lease(this.#motions, source, async (strut) => strut.openMotion(source, call), call));
  }

  /** Keeps the engine while the lease lasts. */
  async #counted<T>(leasing: Promise<Lease<T>>): Promise<Lease<T>> {
    const use = this.#use.lease();
    try {
      const { value, release } = await leasing;
      return {
        value,
        release: () => {
          release();
          use.release();
        },
      };
    } catch (thrown) {
      use.release();
      throw thrown;
    }
  }

  #end(): void {
    const strut = this.#strut;
    this.#strut = undefined;
    strut?.then((loaded) => loaded.dispose()).catch(() => undefined);
  }

  async #lease<T extends Opened>(
    shared: SharedSources<T>,
    source: Source,
    open: (strut: Strut) => Promise<T>,
    call: CallOptions,
  ): Promise<Lease<T>> {
    if (typeof source === "string" || source instanceof URL) return shared.lease(addressOf(source), call);
    const value = await open(await this.strut());
    return { value, release: () => value.dispose() };
  }
}

/** Objects opened by the page are also closed by it. */
function given<T>(value: T): Lease<T> {
  return { value, release: () => undefined };
}

const isOpened = <T extends Database | Motion>(source: Source | T): source is T =>
  typeof source === "object" && "dispose" in source;

/** An absolute URL; names of built-in objects and texts of files are unchanged. */
function addressOf(source: string | URL): string {
  const text = String(source);
  return text.startsWith("strut:") || text.includes("\n") ? text : new URL(text, document.baseURI).href;
}
