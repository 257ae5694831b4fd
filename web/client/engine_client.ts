/**
 * The engine for callers on another thread: any number of databases, motions, sessions and live stylizers in one
 * worker, and the models of walks and key styles, which run on the calling thread.
 */

import type { BuiltInSet } from "../engine/built_in";
import { disposed } from "../engine/errors";
import { DEFAULT_OPTIONS } from "../engine/types";
import type { ClientAtlas } from "./atlas/client_atlas";
import type { BuildClient } from "./build/client";
import { Connection, DEFAULT_PATIENCE, type Patience, type Reopenable } from "./connection";
import { ClientDatabase, type ClientHandle, ClientMotion, ClientSession, ClientStylizer } from "./handles";
import type { KeyStyleModel, KeyStyleModelSource } from "./models/key_style";
import type { WalkModel, WalkModelSource } from "./models/walk";
import { changedOptions } from "./options";
import {
  type CallOptions,
  type DatabaseSource,
  type InputSource,
  type MemoryInfo,
  STYLE_HALF_LIFE_SECS,
  type StylizeOptions,
} from "./protocol";
import type { WorkerPort } from "./rpc";

/** How the workers are started and watched; tests replace it. */
export interface EngineClientSetup {
  spawn?: () => WorkerPort;
  /** A set of built-in motions that starts loading with the engine. */
  preload?: BuiltInSet;
  spawnBuild?: () => WorkerPort;
  patience?: Partial<Patience>;
}

/** Event after a fault. */
export interface EngineRestart {
  /** What failed, a sentence for the user. */
  message: string;
  /** Handles that could not be reopened and take no more calls, and the reasons. */
  lost: { thing: object; reason: string }[];
}

/**
 * The caller owns every returned handle and disposes of it. Sources are copied and kept. After a fault, all pending
 * calls reject with code `fault`, another worker replaces the failed one, everything is reopened with its options and
 * position, and `onRestart` is called. What cannot be reopened is closed. After a second fault before anything was
 * styled, everything is closed.
 */
export class EngineClient {
  onRestart: ((restart: EngineRestart) => void) | undefined;
  private readonly connection: Connection;
  private disposed = false;
  /** Models and builds, which are not in the worker. */
  private readonly owned = new Set<{ dispose(): void }>();
  private readonly spawnBuild: (() => WorkerPort) | undefined;

  /** The worker starts at once; calls wait until its engine is loaded. */
  constructor({ spawn = spawnWorker, preload, spawnBuild, patience }: EngineClientSetup = {}) {
    this.connection = new Connection(preload ? () => preloading(spawn(), preload) : spawn, {
      ...DEFAULT_PATIENCE,
      ...patience,
    });
    this.connection.onRestart = (restart) => this.onRestart?.(restart);
    this.spawnBuild = spawnBuild;
    // Calls are rejected with the same error.
    this.ready().catch(() => {});
  }

  /**
   * Resolves when the engine is loaded.
   * @throws StrutError `load` or `unsupported`
   */
  ready(): Promise<void> {
    return this.connection.ready();
  }

  async openDatabase(source: DatabaseSource, options?: CallOptions): Promise<ClientDatabase> {
    const { connection } = this;
    const id = connection.nextId();
    const info = await connection.call("openDatabase", [id, source], options);
    return new ClientDatabase(connection, id, info, source);
  }

  /** Names of the motions of a built-in set, the default first. */
  builtInMotions(set: BuiltInSet = "built-in"): Promise<string[]> {
    return this.connection.call("builtInInputs", [set]);
  }

  /** Opens a motion, which is read when it is first used with a database. */
  async openMotion(source: InputSource, options?: CallOptions): Promise<ClientMotion> {
    const { connection } = this;
    const id = connection.nextId();
    // The caller may reuse its bytes; they are needed again after a fault.
    const { exact, ...kept } =
      source.kind === "bvh" ? { ...source, bytes: source.bytes.slice() } : { ...source, exact: undefined };
    await connection.call("openMotion", [id, kept], options);
    return new ClientMotion(connection, id, kept, exact);
  }

  /** Creates a session that plays a motion in a database. */
  async createSession(
    database: ClientDatabase,
    motion: ClientMotion,
    options: Partial<StylizeOptions> = {},
    call?: CallOptions,
  ): Promise<ClientSession> {
    const { connection } = this;
    const id = connection.nextId();
    const all = changedOptions(database.info, DEFAULT_OPTIONS, options);
    const ids = { database: openId(database), motion: openId(motion) };
    const setup = { ...ids, options: all, loop: true, range: undefined, inputFrame: undefined };
    await connection.call("createSession", [id, setup], call);
    return new ClientSession(connection, id, database, motion, all);
  }

  /** Creates a stylizer for poses as they arrive. */
  async createStylizer(
    database: ClientDatabase,
    options: Partial<StylizeOptions> = {},
    call?: CallOptions,
  ): Promise<ClientStylizer> {
    const { connection } = this;
    const id = connection.nextId();
    const all = changedOptions(database.info, DEFAULT_OPTIONS, options);
    await connection.call("createStylizer", [id, openId(database), all, STYLE_HALF_LIFE_SECS], call);
    return new ClientStylizer(connection, id, database, all, STYLE_HALF_LIFE_SECS);
  }

  /** Opens an object of a kind whose code is not loaded with the engine. */
  openBy<T>(open: (connection: Connection) => Promise<T>): Promise<T> {
    return open(this.connection);
  }

  /** Opens an atlas: a motion on a database as a picture of all distances, with at most `columns` columns; see `atlas/`. */
  async openAtlas(
    database: ClientDatabase,
    motion: ClientMotion,
    columns: number,
    options?: CallOptions,
  ): Promise<ClientAtlas> {
    const { ClientAtlas } = await import("./atlas/client_atlas");
    return ClientAtlas.open(this.connection, database, motion, columns, options);
  }

  /** Opens a walk model, trained first if a database is given. */
  async openWalk(source: WalkModelSource, options?: CallOptions): Promise<WalkModel> {
    const { openWalk } = await import("./models/walk");
    return this.own(await openWalk(source, options, this.spawnBuild));
  }

  /** Opens a key-style model, trained first if motions are given. */
  async openKeyStyle(source: KeyStyleModelSource, options?: CallOptions): Promise<KeyStyleModel> {
    const { openKeyStyle } = await import("./models/key_style");
    return this.own(await openKeyStyle(source, options, this.spawnBuild));
  }

  /** Whether a handle belongs to this client. */
  owns(handle: ClientHandle): boolean {
    return handle.isOf(this.connection);
  }

  /** Runs `work` with a build client, whose worker ends with it. */
  async build<T>(work: (builds: BuildClient) => Promise<T>): Promise<T> {
    const { BuildClient } = await import("./build/client");
    const builds = this.own(new BuildClient(this.spawnBuild));
    try {
      return await work(builds);
    } finally {
      builds.dispose();
      this.owned.delete(builds);
    }
  }

  /** Memory of the engine in the worker; models are not in it. */
  async memory(): Promise<MemoryInfo> {
    return { ...(await this.connection.call("memory", [])), open: this.connection.memory() };
  }

  /** Disposes of everything once all pending calls are answered. */
  async retire(): Promise<void> {
    await this.connection.idle();
    this.dispose();
  }

  /** Closes everything, including models and builds, and terminates the workers. */
  dispose(): void {
    this.disposed = true;
    this.connection.dispose();
    for (const thing of this.owned) thing.dispose();
    this.owned.clear();
  }

  private own<T extends { dispose(): void }>(thing: T): T {
    if (this.disposed) {
      thing.dispose();
      throw disposed("client");
    }
    this.owned.add(thing);
    return thing;
  }
}

/** @throws StrutError with the reason why it is no longer open */
function openId(handle: Reopenable): number {
  if (handle.closed) throw handle.closed;
  return handle.id;
}

function preloading(worker: WorkerPort, set: BuiltInSet): WorkerPort {
  worker.postMessage({ kind: "preload", set }, []);
  return worker;
}

function spawnWorker(): WorkerPort {
  return new Worker(new URL("./worker.ts", import.meta.url), { type: "module", name: "strut" });
}
