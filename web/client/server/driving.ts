/** Calls about driving; their code is loaded with the first one. */

import type { Database } from "../../engine/database";
import { bvhOfPoses, Driver, inputOfPoses, loadTakes } from "../../engine/drive/driver";
import type { Stylizer } from "../../engine/stylizer";
import type { DriveControl, DriveFrame, DriveInfo, Driven, Root } from "../drive/protocol";
import type { StylizeOptions } from "../protocol";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import { DriveSession } from "./drive_session";
import type { Host } from "./host";
import { CarriedMotion, OpenMotion } from "./motions";
import type { OpenThing } from "./registry";
import { stage } from "./time_slices";

/** A driven character. */
class OpenDrive implements OpenThing {
  static readonly noun = "drive";
  readonly uses: readonly number[];

  constructor(
    readonly database: number,
    private readonly stylizer: Stylizer,
    private readonly driver: Driver,
    readonly session: DriveSession,
  ) {
    this.uses = [database];
  }

  dispose(): void {
    this.driver.dispose();
    this.stylizer.dispose();
  }
}

export async function openDrive(
  host: Host,
  caller: Caller,
  id: number,
  databaseId: number,
  options: StylizeOptions,
  root: Root,
): Promise<DriveInfo> {
  await stage(caller, "Making ready to drive", 0);
  const { engine, open } = host;
  const { database } = open.get(OpenDatabase, databaseId);
  const driver = await openDriver(host, caller, database);
  const stylizer = engine.createStylizer(database, options);
  try {
    const { styles, neutral, rateHz } = database.info;
    const interpolate = engine.interpolate.bind(engine);
    // If there is a note, the walking clips are from another database.
    const inputStyle = driver.note === "" ? neutral : "";
    const session = new DriveSession(stylizer, driver, styles, rateHz, inputStyle, options, interpolate, root);
    open.add(id, new OpenDrive(databaseId, stylizer, driver, session));
  } catch (thrown) {
    driver.dispose();
    stylizer.dispose();
    throw thrown;
  }
  return {
    speeds: driver.speeds,
    moves: driver.moves,
    clips: driver.clips.length,
    frames: driver.rows,
    note: driver.note,
  };
}

async function openDriver({ engine, builtIn }: Host, caller: Caller, database: Database): Promise<Driver> {
  const takes = engine.openDatabase({ kind: "demo", motions: await loadTakes() });
  const spare = async () => engine.openDatabase({ kind: "demo", motions: await builtIn.load(caller) });
  try {
    return await Driver.open(database, takes, spare);
  } finally {
    takes.dispose();
  }
}

export function drive({ open }: Host, _: Caller, id: number, dtSecs: number, control: DriveControl): DriveFrame {
  return open.get(OpenDrive, id).session.drive(dtSecs, control);
}

export function restyleDrive({ open }: Host, _: Caller, id: number, options: StylizeOptions): undefined {
  open.get(OpenDrive, id).session.configure(options);
}

export function resetDrive({ open }: Host, _: Caller, id: number, root: Root): undefined {
  open.get(OpenDrive, id).session.reset(root);
}

export function takePoses({ open }: Host, _: Caller, motion: number, on: number, poses: Float32Array): undefined {
  const key = CarriedMotion.keyOf(motion, on);
  if (open.find(CarriedMotion, key)) return;
  const { database } = open.get(OpenDatabase, on);
  const input = inputOfPoses(database, open.get(OpenMotion, motion).source, poses);
  open.add(key, new CarriedMotion(input, motion, on));
}

export function driven({ open }: Host, _: Caller, id: number): Driven {
  const { database, session } = open.get(OpenDrive, id);
  const { poses, frames, track } = session.driven();
  const bvh = frames > 0 ? bvhOfPoses(open.get(OpenDatabase, database).database, poses) : "";
  return { bvh, frames, track, poses };
}
