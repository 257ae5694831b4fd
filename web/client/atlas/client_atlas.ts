/** An atlas in the worker: a picture of all distances between a motion and a database. */
import type { Connection, Post } from "../connection";
import { type ClientDatabase, ClientHandle, type ClientMotion } from "../handles";
import type { CallOptions, OpenMemory } from "../protocol";
import type { AtlasFacts, AtlasView, NearestInAtlas, OpenedAtlas, PackedWindows } from "./opened_atlas";

/** Bytes per column: a window, in the form in which it is compared. */
const COLUMN_BYTES = 4200;
/** Bytes per row of the database, on average. */
const ROW_BYTES = 8;

export class ClientAtlas extends ClientHandle implements OpenedAtlas {
  readonly frames: Uint32Array;
  readonly firsts: Uint32Array;

  private constructor(
    connection: Connection,
    id: number,
    private readonly database: ClientDatabase,
    private readonly motion: ClientMotion,
    facts: AtlasFacts,
  ) {
    super(connection, id, [database, motion], "atlas");
    ({ frames: this.frames, firsts: this.firsts } = facts);
  }

  /** @param columns maximum number of columns */
  static async open(
    connection: Connection,
    database: ClientDatabase,
    motion: ClientMotion,
    columns: number,
    options?: CallOptions,
  ): Promise<ClientAtlas> {
    const id = connection.nextId();
    const facts = await connection.call("openAtlas", [id, motion.id, database.id, columns], options);
    return new ClientAtlas(connection, id, database, motion, facts);
  }

  get memory(): OpenMemory {
    const bytes = COLUMN_BYTES * this.frames.length + ROW_BYTES * this.database.info.frames;
    return { kind: "atlas", bytes };
  }

  async draw(view: AtlasView, columns: Uint32Array, options?: CallOptions): Promise<Float32Array> {
    return (await this.call("drawAtlas", [this.id, view, columns], options)).distances;
  }

  nearest(view: AtlasView, column: number, line: number): Promise<NearestInAtlas> {
    return this.call("nearestInAtlas", [this.id, view, column, line]);
  }

  async pose(column: number, clip: number, frame: number): Promise<Float32Array> {
    return (await this.call("atlasPose", [this.id, column, clip, frame])).pose;
  }

  packed(view: AtlasView, options?: CallOptions): Promise<PackedWindows> {
    return this.call("packAtlas", [this.id, view], options);
  }

  packedColumns(view: AtlasView, options?: CallOptions): Promise<PackedWindows> {
    return this.call("packAtlasColumns", [this.id, view], options);
  }

  async lines(view: AtlasView, options?: CallOptions): Promise<Uint32Array> {
    return (await this.call("atlasLines", [this.id, view], options)).lines;
  }

  reopen(post: Post): Promise<unknown> {
    return post("openAtlas", [this.id, this.motion.id, this.database.id, this.frames.length]);
  }
}
