/** A driven character in the worker. */
import type { Connection, Post } from "../connection";
import { type ClientDatabase, ClientHandle } from "../handles";
import type { Id } from "../messages";
import type { CallOptions, OpenMemory, StylizeOptions } from "../protocol";
import type { DriveControl, DriveFrame, DriveInfo, Driven, Root } from "./protocol";

/** Memory in addition to its stream: the clips on both sides, and a minute of driven frames; bytes. */
const DRIVE_BYTES = 20e6;

/** A driven character. After a fault it is at its last position, and its driven frames are lost. */
export class ClientDrive extends ClientHandle {
  private constructor(
    connection: Connection,
    id: Id,
    private readonly database: ClientDatabase,
    private options: StylizeOptions,
    private root: Root,
    readonly info: DriveInfo,
  ) {
    super(connection, id, [database], "drive");
  }

  /**
   * @throws StrutError if the driver, or the built-in clips for a database with too little neutral walking, cannot be
   * loaded
   */
  static async open(
    connection: Connection,
    database: ClientDatabase,
    options: StylizeOptions,
    root: Root,
    call?: CallOptions,
  ): Promise<ClientDrive> {
    const id = connection.nextId();
    const info = await connection.call("openDrive", [id, database.id, options, root], call);
    return new ClientDrive(connection, id, database, options, root, info);
  }

  get memory(): OpenMemory {
    return { kind: "session", bytes: DRIVE_BYTES };
  }

  /** Takes effect with the next frame; a change of the styles fades in. */
  async configure(options: StylizeOptions): Promise<void> {
    await this.call("restyleDrive", [this.id, options]);
    this.options = options;
  }

  async drive(dtSecs: number, control: DriveControl): Promise<DriveFrame> {
    const frame = await this.call("drive", [this.id, dtSecs, control]);
    this.root = frame.root;
    return frame;
  }

  async reset(root: Root): Promise<void> {
    await this.call("resetDrive", [this.id, root]);
  }

  driven(): Promise<Driven> {
    return this.call("driven", [this.id]);
  }

  reopen(post: Post): Promise<unknown> {
    return post("openDrive", [this.id, this.database.id, this.options, this.root]);
  }
}
