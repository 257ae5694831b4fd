/** An atlas in the worker. */
import type { AtlasFacts, AtlasView, NearestInAtlas, PackedWindows } from "../../engine/atlas";
import type { Connection, Post } from "../connection";
import { type ClientDatabase, ClientHandle, type ClientMotion } from "../handles";
import type { CallOptions, OpenMemory } from "../protocol";

/** Bytes per column: a window, in the form in which it is compared. */
const COLUMN_BYTES = 4200;
/** Bytes per row of the database, on average. */
const ROW_BYTES = 8;

export type { AtlasPart, AtlasView, PackedWindows } from "../../engine/atlas";

/** All distances between a motion and a database: columns are frames of the motion at equal intervals, lines are windows. */
export class ClientAtlas extends ClientHandle implements Readonly<AtlasFacts> {
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

  /** Smallest D of each line in some columns, m², column after column. */
  async draw(view: AtlasView, columns: Uint32Array, options?: CallOptions): Promise<Float32Array> {
    return (await this.call("drawAtlas", [this.id, view, columns], options)).distances;
  }

  /** The nearest window of a line in a column. */
  nearest(view: AtlasView, column: number, line: number): Promise<NearestInAtlas> {
    return this.call("nearestInAtlas", [this.id, view, column, line]);
  }

  /** Pose at a frame of a clip, aligned with a column of the motion as in the metric. */
  async pose(column: number, clip: number, frame: number): Promise<Float32Array> {
    return (await this.call("atlasPose", [this.id, column, clip, frame])).pose;
  }

  /** The database's windows for the GPU. */
  packed(view: AtlasView, options?: CallOptions): Promise<PackedWindows> {
    return this.call("packAtlas", [this.id, view], options);
  }

  /** The motion's columns, in the same layout. */
  packedColumns(view: AtlasView, options?: CallOptions): Promise<PackedWindows> {
    return this.call("packAtlasColumns", [this.id, view], options);
  }

  /** Line of each packed window; the largest number for windows without a line. */
  async lines(view: AtlasView, options?: CallOptions): Promise<Uint32Array> {
    return (await this.call("atlasLines", [this.id, view], options)).lines;
  }

  reopen(post: Post): Promise<unknown> {
    return post("openAtlas", [this.id, this.motion.id, this.database.id, this.frames.length]);
  }
}
